//! T21: how the work is shared out never shows.
//!
//! A pixel's samples are summed by one invocation, in order, and written to its own place: no sum depends on who is done
//! first. The bound is 0 pixels.

use super::built_in;
use crate::selftest::{Agreement, Bound, Case, Device, DeviceError, Effort, Finding, Stage};

/// One picture by any number of threads and tiles, rests and bands, time after time.
pub(super) const T21: Case = Case {
    id: "T21",
    title: "how work is shared never shows",
    claim: "the same bits from any number of threads, tiles of any size, rests and bands of any length, and every time",
    run: sharing,
};

fn sharing(device: &mut dyn Device, effort: Effort) -> Result<Vec<Finding>, DeviceError> {
    // No side is a multiple of a tile's.
    let size = match effort {
        Effort::Quick => [21, 18],
        Effort::Short => [37, 29],
        Effort::Long => [321, 241],
    };
    let mut scene = built_in::read(built_in::GLASS, size)?;
    scene.render.samples = 2;
    let stage = Stage::new(&scene)?;
    let first = device.picture(&stage, &stage.settings)?;
    let pictures = device.shared_out(&stage, &stage.settings)?;
    let differing = pictures.into_iter().map(|(way, picture)| {
        let agreement = Agreement::between(&first, &picture);
        Finding {
            what: format!("pixels that differ, {way}"),
            figure: if agreement.is_exact() { 0.0 } else { agreement.differing.max(1) as f64 },
            bound: Bound::AtMost(0.0),
            trials: agreement.pixels as u64,
        }
    });
    Ok(differing.collect())
}
