// The listener at the itinerary: what each ray of a tree met and gave. Twin of src/kernel/record.rs.
//
// Only the variant `tree` has it.

import package::real::{real, vec3r};
import package::bindings::{film, frame};
import package::film::{flush, flush3};
import package::light::Direct;
import package::material::Scatter;
import package::math::max3;
import package::records::TreeNode;
import package::whitted::{Branch, Landing};
import package::constants::{
    CHILD_REFLECTION, CHILD_REFRACTION, END_BACKGROUND, END_DEPTH, END_STUCK, END_SURFACE, END_WEIGHT, TREE_NODES,
};

// A branch that met no surface, or was not traced; `light` is what it added to the pixel.
fn record_end(branch: Branch, light: vec3r, cut: bool) {
    var node: TreeNode;
    node.end = END_BACKGROUND;
    if cut {
        node.end = END_STUCK;
    }
    if cut && max3(branch.weight) < real(frame.view.cutoff) {
        node.end = END_WEIGHT;
    }
    if cut && branch.depth > frame.view.depth {
        node.end = END_DEPTH;
    }
    node.origin = flush3(branch.origin);
    node.kind = branch.kind;
    node.direction = flush3(branch.direction);
    node.depth = branch.depth;
    node.weight = flush3(branch.weight);
    node.light = flush3(light);
    @if(transmission) node.media = branch.media;
    keep(node);
}

// A branch that met a surface; `arriving` is what was left of its weight there, `light` what it added to the pixel.
fn record_surface(
    branch: Branch, landing: Landing, arriving: vec3r, light: vec3r, local: Direct, scattered: Scatter,
) {
    var node: TreeNode;
    @if(reflection) {
        if scattered.reflects {
            node.children += CHILD_REFLECTION;
        }
    }
    @if(transmission) {
        if scattered.transmits {
            node.children += CHILD_REFRACTION;
        }
    }
    node.origin = flush3(branch.origin);
    node.kind = branch.kind;
    node.direction = flush3(branch.direction);
    node.depth = branch.depth;
    node.weight = flush3(branch.weight);
    node.end = END_SURFACE;
    node.light = flush3(light);
    @if(transmission) node.media = landing.media;
    node.point = flush3(landing.surface.point);
    node.id = landing.surface.id;
    node.normal = flush3(landing.surface.normal);
    node.body = landing.surface.body;
    node.arriving = flush3(arriving);
    @if(transmission) node.media_behind = landing.media_behind;
    node.distance = flush(landing.distance);
    node.front = select(0u, 1u, landing.surface.front);
    node.seen = local.seen;
    node.shadow_rays = local.shadow_rays;
    keep(node);
}

// Write a node behind the others. Only one invocation traces; what does not fit is counted.
fn keep(node: TreeNode) {
    @if(tree) {
        let count = film.tree.count;
        if count < TREE_NODES {
            film.tree.nodes[count] = node;
        }
        film.tree.count = count + 1u;
    }
}
