//! What the last change of a setting cost: time, and how far it moved the picture.

use crate::film::Frame;
use crate::layout::Settings;

/// A finished picture, to compare the next one with.
#[derive(Debug, Clone)]
pub(super) struct Finished {
    /// How it was traced.
    pub(super) settings: Settings,
    /// Milliseconds of tracing.
    pub(super) ms: f64,
    /// The picture.
    pub(super) frame: Frame,
}

/// What a change of the settings cost, measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Cost {
    /// What changed, in words.
    pub change: String,
    /// Milliseconds of tracing before and after.
    pub ms: [f64; 2],
    /// Root mean square over pixels and channels of what it moved, in linear radiance clamped to [0, 1].
    pub moved: f64,
}

impl Cost {
    /// Compare two pictures of the same view; none where nothing but time differs.
    pub(super) fn of(before: &Finished, after: &Finished) -> Option<Self> {
        let change = changes(&before.settings, &after.settings);
        if change.is_empty() || before.frame.texels.len() != after.frame.texels.len() {
            return None;
        }
        let pairs = before.frame.texels.iter().zip(&after.frame.texels);
        let squares: f64 = pairs
            .flat_map(|(a, b)| a.radiance.into_iter().zip(b.radiance))
            .map(|(a, b)| f64::from(a.clamp(0.0, 1.0) - b.clamp(0.0, 1.0)).powi(2))
            .sum();
        let moved = (squares / (3 * before.frame.texels.len()).max(1) as f64).sqrt();
        Some(Self { change: change.join(", "), ms: [before.ms, after.ms], moved })
    }
}

/// What differs between two settings, in words.
fn changes(before: &Settings, after: &Settings) -> Vec<String> {
    let mut found = Vec::new();
    let mut note = |name: &str, before: String, after: String| {
        if before != after {
            found.push(format!("{name} {before} → {after}"));
        }
    };
    let adaptive =
        |settings: &Settings| settings.adaptive.map_or_else(|| "off".to_owned(), |t| format!("{t}"));
    note("depth", before.depth.to_string(), after.depth.to_string());
    note("cut-off", format!("{:e}", before.cutoff), format!("{:e}", after.cutoff));
    note("samples", before.samples.to_string(), after.samples.to_string());
    note("adaptive", adaptive(before), adaptive(after));
    note("precision", format!("{:?}", before.precision), format!("{:?}", after.precision));
    note("arithmetic", format!("{:?}", before.float), format!("{:?}", after.float));
    note("triangles", format!("{:?}", before.intersector), format!("{:?}", after.intersector));
    if before.effects != after.effects {
        found.push("effects".to_owned());
    }
    found
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::film::test_frame;

    fn finished(depth: u32, ms: f64, radiance: f32) -> Finished {
        let mut frame = test_frame(2, 1);
        frame.texels[1].radiance = [radiance; 3];
        Finished { settings: Settings { depth, ..Settings::default() }, ms, frame }
    }

    #[test]
    fn a_change_is_named_with_its_time_and_what_it_moves() {
        let cost = Cost::of(&finished(16, 20.0, 0.5), &finished(8, 12.0, 0.3)).unwrap();
        assert_eq!((cost.change.as_str(), cost.ms), ("depth 16 → 8", [20.0, 12.0]));
        assert!((cost.moved - 0.2 / 2_f64.sqrt()).abs() < 1e-6, "{}", cost.moved);
        assert_eq!(Cost::of(&finished(16, 20.0, 0.5), &finished(16, 21.0, 0.5)), None);
    }
}
