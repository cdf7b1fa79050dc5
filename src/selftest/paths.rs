//! Bent paths on the CPU. Twin of `shaders/probe_paths.wgsl`.

use super::{Bend, Bent, Ending};
use crate::kernel::material::scatter;
use crate::kernel::media::{attenuation, current_medium};
use crate::kernel::surface::{spawn_before, spawn_behind};
use crate::kernel::whitted::{Branch, find_surface};
use crate::kernel::{Real, Vec3, World};
use crate::layout::constants::{BEND_ABSORBED, BEND_FREE, BEND_LIMIT, NONE, RAY_PRIMARY};

/// Words of a record up to the ids: how it ended, surfaces, reflections, media.
const BEHIND_IDS: usize = 4 + BEND_LIMIT as usize;
/// Words of a record: origin, direction and weight come behind the ids, then the canary.
pub(super) const BEND_WORDS: usize = BEHIND_IDS + 10;

/// Follow one path.
pub(super) fn bend<R: Real>(world: &World, ray: &Bend) -> Bent {
    let mut branch = Branch {
        origin: Vec3::<R>::load(ray.origin),
        media: ray.media,
        direction: Vec3::load(ray.direction),
        depth: 0,
        weight: Vec3::one(),
        kind: RAY_PRIMARY,
        origin_face: NONE,
    };
    let mut ids = [NONE; BEND_LIMIT as usize];
    // One surface after the other.
    let mut end = Ending::Limit;
    let mut surfaces = 0;
    let mut reflected = 0;
    while surfaces < ray.limit {
        let landing = find_surface(world, &branch);
        if !landing.found {
            end = Ending::Free;
            branch.media = landing.media;
            break;
        }
        let before = current_medium(world, landing.media);
        let behind = current_medium(world, landing.media_behind);
        let bit = 1 << surfaces;
        ids[surfaces as usize] = landing.surface.id;
        surfaces += 1;
        branch.weight = branch.weight * attenuation(world, before, landing.distance);
        // The child that is asked for; the other where there is no such child.
        let children = scatter(world, &landing.surface, branch.direction, before, behind);
        if !children.reflects && !children.transmits {
            end = Ending::Absorbed;
            break;
        }
        branch.origin_face = landing.surface.id;
        if children.reflects && ((ray.reflect & bit) != 0 || !children.transmits) {
            reflected |= bit;
            branch.origin = spawn_before(&landing.surface);
            branch.media = landing.media;
            branch.direction = children.reflected;
            branch.weight = branch.weight * children.reflection;
        } else {
            branch.origin = spawn_behind(&landing.surface);
            branch.media = landing.media_behind;
            branch.direction = children.refracted;
            branch.weight = branch.weight * children.transmission;
        }
    }
    let narrow = |v: Vec3<R>| [v.x, v.y, v.z].map(R::to_f32);
    Bent {
        end,
        surfaces,
        reflected,
        media: branch.media,
        ids,
        origin: narrow(branch.origin),
        direction: narrow(branch.direction),
        weight: narrow(branch.weight),
    }
}

impl Bend {
    /// Write the record that the probe reads.
    pub(super) fn write(&self, words: &mut Vec<u32>) {
        words.extend(self.origin.map(f32::to_bits));
        words.extend(self.direction.map(f32::to_bits));
        words.extend([self.media, self.reflect, self.limit]);
    }
}

impl Bent {
    /// Read what the probe wrote.
    pub(super) fn read(words: &[u32]) -> Self {
        let vector = |first: usize| std::array::from_fn(|axis| f32::from_bits(words[first + axis]));
        Self {
            end: match words[0] {
                BEND_FREE => Ending::Free,
                BEND_ABSORBED => Ending::Absorbed,
                _ => Ending::Limit,
            },
            surfaces: words[1],
            reflected: words[2],
            media: words[3],
            ids: std::array::from_fn(|k| words[4 + k]),
            origin: vector(BEHIND_IDS),
            direction: vector(BEHIND_IDS + 3),
            weight: vector(BEHIND_IDS + 6),
        }
    }
}
