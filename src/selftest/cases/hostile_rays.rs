//! T18: rays that no scene should make. (Files that no one should write are refused with line and column before a device
//! sees them: `tests/fuzz` and `tests/cli`.)
//!
//! A ray with a NaN, or with a number that no scene can give it, meets nothing: it is told from an ordinary one before it
//! enters a box. Subnormal components count as 2^-40 in the slab test, as small ones do. So a hostile ray does no more
//! than an ordinary one, and the bound, 2.5 times as long, leaves room for the clock only.

use std::time::{Duration, Instant};

use crate::scene::{Material, MaterialId, Model, Scene};
use crate::selftest::{Bound, Case, Device, DeviceError, Effort, Finding, Random, Stage, Walk, solids};

/// Rays of NaN, infinities, subnormal and huge numbers.
pub(super) const T18: Case = Case {
    id: "T18",
    title: "hostile rays do no harm",
    claim: "rays with NaN, infinite, subnormal or huge numbers in them neither hang nor crash a device, and take at most 2.5 \
            times as long as ordinary ones",
    run: hostile_rays,
};

/// What stands where a number should.
const HOSTILE: [f32; 9] =
    [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN, 1e-40, -1e-45, 1e30, -0.0];
/// Each time is the least of so many.
const TRIES: usize = 3;
/// Most faces that a ray may cross.
const LIMIT: u32 = 16;

fn hostile_rays(device: &mut dyn Device, effort: Effort) -> Result<Vec<Finding>, DeviceError> {
    let count = match effort {
        Effort::Quick => 5_000,
        Effort::Short => 10_000,
        Effort::Long => 1_000_000,
    };
    let mesh = solids::jittered_sphere(50, &mut Random::new("hostile"));
    let model = Model::of("ball", mesh, MaterialId(0));
    let stage = Stage::new(&Scene::of(vec![Material::clear("ice", 1.31)], vec![model]))?;
    let mut random = Random::new("hostile rays");
    let ordinary: Vec<Walk> = (0..count).map(|_| ordinary(&mut random)).collect();
    let hostile: Vec<Walk> = ordinary.iter().map(|ray| spoilt(*ray, &mut random)).collect();
    // Shaders are compiled with the first.
    device.walk(&stage, &ordinary)?;
    let (usual, _) = time(device, &stage, &ordinary)?;
    let (taken, endless) = time(device, &stage, &hostile)?;
    let trials = count as u64;
    Ok(vec![
        Finding {
            what: "times as long as ordinary rays take".into(),
            figure: taken.as_secs_f64() / usual.as_secs_f64().max(1e-9),
            bound: Bound::AtMost(2.5),
            trials,
        },
        Finding {
            what: "hostile rays that cross as many faces as they may".into(),
            figure: endless as f64,
            bound: Bound::Reported,
            trials,
        },
    ])
}

/// From anywhere around the ball, to any side.
fn ordinary(random: &mut Random) -> Walk {
    Walk {
        origin: (random.direction() * 2.0 * random.fraction()).as_vec3().to_array(),
        direction: random.direction().as_vec3().to_array(),
        media: 0,
        limit: LIMIT,
    }
}

/// With one to three of its numbers replaced.
fn spoilt(mut ray: Walk, random: &mut Random) -> Walk {
    for _ in 0..=random.below(3) {
        let number = HOSTILE[random.below(HOSTILE.len() as u32) as usize];
        let triple = if random.below(2) == 0 { &mut ray.origin } else { &mut ray.direction };
        triple[random.below(3) as usize] = number;
    }
    ray
}

/// The least time that the rays take, and how many of them reach the limit of faces.
fn time(device: &mut dyn Device, stage: &Stage, rays: &[Walk]) -> Result<(Duration, usize), DeviceError> {
    let (mut least, mut endless) = (Duration::MAX, 0);
    for _ in 0..TRIES {
        let start = Instant::now();
        let walked = device.walk(stage, rays)?;
        least = least.min(start.elapsed());
        endless = walked.iter().filter(|walked| walked.faces == LIMIT).count();
    }
    Ok((least, endless))
}
