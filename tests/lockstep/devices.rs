//! The software adapters that tests run on: here, and beside the code in src/gpu.

use std::path::Path;
use std::sync::Once;

use super::gpu::{GpuOptions, adapters};

/// Where browsers keep SwiftShader's driver manifest.
const SWIFTSHADER: [&str; 5] = [
    "/usr/lib/chromium/vk_swiftshader_icd.json",
    "/usr/lib/chromium-browser/vk_swiftshader_icd.json",
    "/usr/lib64/chromium-browser/vk_swiftshader_icd.json",
    "/opt/google/chrome/vk_swiftshader_icd.json",
    "/usr/share/vulkan/icd.d/vk_swiftshader_icd.json",
];

/// Run a test on lavapipe and on SwiftShader.
pub(crate) fn on_each(test: impl Fn(&GpuOptions)) {
    for part in ["llvmpipe", "swiftshader"] {
        if let Some(options) = find(part) {
            test(&options);
        }
    }
}

/// The adapter of that name. Where it is missing the test is skipped with a line, but fails in CI.
pub(crate) fn find(part: &str) -> Option<GpuOptions> {
    show_swiftshader();
    if adapters().iter().any(|adapter| adapter.name.to_lowercase().contains(part)) {
        return Some(GpuOptions { adapter: Some(part.to_owned()), ..GpuOptions::default() });
    }
    assert!(std::env::var("CI").as_deref() != Ok("true"), "no adapter {part}: CI installs one, see .ci/run");
    eprintln!("skipped on {part}: no such adapter on this machine");
    None
}

/// Point the Vulkan loader at SwiftShader, which no package registers.
fn show_swiftshader() {
    static SHOWN: Once = Once::new();
    const VARIABLE: &str = "VK_ADD_DRIVER_FILES";
    SHOWN.call_once(|| {
        let found = SWIFTSHADER.iter().find(|path| Path::new(path).exists());
        let chosen = std::env::var_os(VARIABLE).is_some() || std::env::var_os("VK_DRIVER_FILES").is_some();
        if let (Some(path), false) = (found, chosen) {
            // SAFETY: every test that loads Vulkan, whose C code reads the environment, comes through here first,
            // and the others change nothing there.
            unsafe { std::env::set_var(VARIABLE, path) };
        }
    });
}
