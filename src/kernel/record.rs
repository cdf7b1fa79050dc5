//! The listener at the itinerary: what each ray of a tree met and gave. Twin of `shaders/record.wgsl`.
//!
//! Pictures are traced without it: [`Simulation::records`] is then known to be false as the kernel is compiled.

use crate::layout::TreeNode;
use crate::layout::constants::{
    CHILD_REFLECTION, CHILD_REFRACTION, END_BACKGROUND, END_DEPTH, END_STUCK, END_SURFACE, END_WEIGHT,
};

use super::film::{flush, flush3};
use super::light::Direct;
use super::material::Scatter;
use super::math::max3;
use super::whitted::{Branch, Landing};
use super::{Real, Simulation, Vec3, World};

/// A branch that met no surface, or was not traced; `light` is what it added to the pixel.
pub fn record_end<R: Real>(world: &World<impl Simulation>, branch: &Branch<R>, light: Vec3<R>, cut: bool) {
    if !world.effects.records() {
        return;
    }
    let mut end = END_BACKGROUND;
    if cut {
        end = END_STUCK;
    }
    if cut && max3(branch.weight) < R::real(world.view.cutoff) {
        end = END_WEIGHT;
    }
    if cut && branch.depth > world.view.depth {
        end = END_DEPTH;
    }
    keep(
        world,
        TreeNode {
            origin: flush3(branch.origin),
            kind: branch.kind,
            direction: flush3(branch.direction),
            depth: branch.depth,
            weight: flush3(branch.weight),
            end,
            light: flush3(light),
            media: branch.media,
            ..TreeNode::default()
        },
    );
}

/// A branch that met a surface; `arriving` is what was left of its weight there, `light` what it added to the pixel.
pub fn record_surface<R: Real>(
    world: &World<impl Simulation>,
    branch: &Branch<R>,
    landing: &Landing<R>,
    arriving: Vec3<R>,
    light: Vec3<R>,
    local: &Direct<R>,
    scattered: &Scatter<R>,
) {
    if !world.effects.records() {
        return;
    }
    let mut children = 0;
    if scattered.reflects {
        children += CHILD_REFLECTION;
    }
    if scattered.transmits {
        children += CHILD_REFRACTION;
    }
    keep(
        world,
        TreeNode {
            origin: flush3(branch.origin),
            kind: branch.kind,
            direction: flush3(branch.direction),
            depth: branch.depth,
            weight: flush3(branch.weight),
            end: END_SURFACE,
            light: flush3(light),
            media: landing.media,
            point: flush3(landing.surface.point),
            id: landing.surface.id,
            normal: flush3(landing.surface.normal),
            body: landing.surface.body,
            arriving: flush3(arriving),
            media_behind: landing.media_behind,
            distance: flush(landing.distance),
            front: u32::from(landing.surface.front),
            children,
            seen: local.seen,
            shadow_rays: local.shadow_rays,
            reserved: [0; 3],
        },
    );
}

/// Hand a node to whoever listens.
pub fn keep(world: &World<impl Simulation>, node: TreeNode) {
    world.effects.record(node);
}
