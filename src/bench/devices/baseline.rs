//! Rows against those of an earlier run.

use serde::Serialize;

use super::row::SceneRow;
use crate::bench::Spread;

/// What became of a trace time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// It grew by more than is allowed, both intervals left out.
    Grown,
    /// It did not.
    Kept,
    /// The earlier run did not trace the same picture there.
    New,
}

/// A scene on a device, then and now.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Change {
    /// The scene.
    pub scene: String,
    /// The device.
    pub device: String,
    /// The trace time of the earlier run; none of [`Verdict::New`].
    pub before_ms: Option<Spread>,
    /// The trace time.
    pub now_ms: Spread,
    /// What is said of the two.
    pub verdict: Verdict,
}

/// Hold each trace time against that of an earlier run: it has grown if the lower end of its interval lies above the upper
/// end of the earlier one by more than a share of `allowed`.
#[must_use]
pub fn compare_with(before: &[SceneRow], now: &[SceneRow], allowed: f64) -> Vec<Change> {
    let devices = now.iter().flat_map(|row| row.devices.iter().map(move |side| (row, side)));
    let change = |(row, side): (&SceneRow, &super::DeviceRow)| {
        // Another size or other rays are another picture, which takes another time.
        let same =
            before.iter().find(|old| (&old.scene, old.size, old.rays) == (&row.scene, row.size, row.rays));
        let old = same.and_then(|old| old.devices.iter().find(|old| old.device == side.device));
        let verdict = match old {
            None => Verdict::New,
            Some(old) if side.trace_ms.low > old.trace_ms.high * (1.0 + allowed) => Verdict::Grown,
            Some(_) => Verdict::Kept,
        };
        Change {
            scene: row.scene.clone(),
            device: side.device.clone(),
            before_ms: old.map(|old| old.trace_ms),
            now_ms: side.trace_ms,
            verdict,
        }
    };
    devices.map(change).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{ByKind, DeviceRow, Phases};
    use super::*;
    use crate::bench::Ratio;

    fn row(device: &str, low: f64, high: f64) -> SceneRow {
        let one = Ratio { median: 1.0, low: 1.0, high: 1.0 };
        let none = ByKind { primary: 0.0, reflection: 0.0, refraction: 0.0, shadow: 0.0, total: 0.0 };
        SceneRow {
            scene: "ice.toml".into(),
            size: [320, 240],
            triangles: 1,
            rounds: 9,
            rays: ByKind { primary: 9, reflection: 3, refraction: 2, shadow: 1, total: 15 },
            devices: vec![DeviceRow {
                device: device.into(),
                threads: Some(1),
                software: false,
                trace_ms: Spread { median: f64::midpoint(low, high), low, high },
                timestamps: false,
                mrays_per_s: none,
                ratio: one,
                picture_ms: 0.0,
                phases_ms: Phases::default(),
                break_even: None,
            }],
            scaling: vec![],
        }
    }

    fn verdict(before: &SceneRow, now: &SceneRow) -> Verdict {
        compare_with(std::slice::from_ref(before), std::slice::from_ref(now), 0.05)[0].verdict
    }

    #[test]
    fn a_time_has_grown_where_the_intervals_are_farther_apart_than_allowed() {
        let before = row("CPU", 90.0, 100.0);
        for (low, expected) in
            [(90.0, Verdict::Kept), (104.9, Verdict::Kept), (105.1, Verdict::Grown), (50.0, Verdict::Kept)]
        {
            assert_eq!(verdict(&before, &row("CPU", low, low + 10.0)), expected, "{low}");
        }
    }

    #[test]
    fn only_the_same_picture_on_the_same_device_is_compared() {
        let before = row("CPU", 90.0, 100.0);
        let now = row("CPU", 900.0, 1000.0);
        assert_eq!(verdict(&before, &now), Verdict::Grown);
        assert_eq!(verdict(&before, &row("GPU", 900.0, 1000.0)), Verdict::New);
        assert_eq!(verdict(&SceneRow { size: [64, 48], ..before.clone() }, &now), Verdict::New);
        let rays = ByKind { total: 14, ..before.rays };
        assert_eq!(verdict(&SceneRow { rays, ..before.clone() }, &now), Verdict::New);
        assert_eq!(verdict(&SceneRow { scene: "whitted.toml".into(), ..before }, &now), Verdict::New);
    }

    #[test]
    fn a_row_comes_back_from_its_json() {
        let row = row("CPU", 90.0, 100.0);
        let text = serde_json::to_string(&row).unwrap_or_default();
        assert_eq!(serde_json::from_str::<SceneRow>(&text).ok(), Some(row));
    }
}
