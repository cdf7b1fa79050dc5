//! Which device traces.

use egui::{RichText, Ui};

use super::super::Backend;
use super::super::session::{Order, Session};

/// Choose among the CPU and the adapters.
pub(super) fn show(ui: &mut Ui, session: &mut Session) {
    let is_cpu = matches!(session.backend, Backend::Cpu { .. });
    let threads = if session.threads == 0 {
        "one thread a core".to_owned()
    } else {
        format!("{} threads", session.threads)
    };
    let cpu = ui.radio(is_cpu, "CPU").on_hover_text(format!("rayon, {threads} (--backend cpu)"));
    if cpu.clicked() {
        session.backend = Backend::Cpu { threads: session.threads };
    }
    for adapter in session.adapters.clone() {
        if !adapter.knows_windows() {
            continue;
        }
        let is_window = adapter.name == session.adapter.name;
        let response = ui.radio(!is_cpu && is_window, RichText::new(&adapter.name)).on_hover_text(format!(
            "{} {}\n{}{}{}",
            adapter.driver,
            adapter.driver_info,
            adapter.kind.name(),
            if adapter.strict_float {
                "; the CPU's bits with strict arithmetic"
            } else {
                "; fast arithmetic only"
            },
            if adapter.f64 { "; 64-bit floats" } else { "" },
        ));
        if response.clicked() {
            if !is_window {
                session.orders.push(Order::UseAdapter(adapter.name.clone()));
            }
            session.backend = Backend::Gpu;
        }
    }
    ui.label(RichText::new("The window is shown by the adapter chosen last.").small().weak());
}
