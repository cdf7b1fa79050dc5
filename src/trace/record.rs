//! The tree of a pixel on the CPU.

use std::sync::{Mutex, PoisonError};

use crate::kernel::whitted::trace_pixel;
use crate::kernel::{Real, Simulation, World};
use crate::layout::{Aov, Effect, FlatScene, Precision, Settings, Texel, TreeNode, View};

/// What a device recorded of a pixel's first sample.
#[derive(Debug, Clone)]
pub struct Recorded {
    /// The rays in the order of tracing.
    pub nodes: Vec<TreeNode>,
    /// The pixel.
    pub texel: Texel,
}

/// Trace the first sample of one pixel of the whole picture on the CPU, and record its tree: the loop is that of every
/// picture, with a listener.
#[must_use]
pub fn on_cpu(scene: &FlatScene, view: &View, settings: &Settings, pixel: [u32; 2]) -> Recorded {
    match settings.precision {
        Precision::F32 => record::<f32>(scene, view, settings, pixel),
        Precision::F64 => record::<f64>(scene, view, settings, pixel),
    }
}

fn record<R: Real>(scene: &FlatScene, view: &View, settings: &Settings, pixel: [u32; 2]) -> Recorded {
    let nodes = Mutex::default();
    let view = View { samples: 1, ..*view };
    let world =
        World { scene, view: &view, intersector: settings.intersector, effects: Listener { nodes: &nodes } };
    let (mut stack, mut texel, mut aov) = (Vec::new(), Texel::default(), Aov::default());
    trace_pixel::<R>(&world, &mut stack, pixel, 0..1, &mut texel, &mut aov, None);
    Recorded { nodes: nodes.into_inner().unwrap_or_else(PoisonError::into_inner), texel }
}

/// Simulates everything, and hears of every ray.
#[derive(Debug, Clone, Copy)]
struct Listener<'a> {
    nodes: &'a Mutex<Vec<TreeNode>>,
}

impl Simulation for Listener<'_> {
    fn simulates(self, _effect: Effect) -> bool {
        true
    }

    fn records(self) -> bool {
        true
    }

    fn record(self, node: TreeNode) {
        self.nodes.lock().unwrap_or_else(PoisonError::into_inner).push(node);
    }
}
