//! The ray tree of one pixel, as an adapter traces it.

use super::pace::Pace;
use super::{GpuError, GpuRenderer, Variant};
use crate::film::{Frame, RayCounts, SampleCounts, TraceTimes};
use crate::layout::constants::TREE_NODES;
use crate::layout::{Effect, Float, Plan, Settings, Texel, TreeNode, View};

/// Bytes before the first node: the number of nodes, padded.
const NODES_AT: u64 = 16;

/// What an adapter recorded of one pixel.
#[derive(Debug, Clone)]
pub struct GpuTree {
    /// The rays in the order of tracing, at most [`TREE_NODES`].
    pub nodes: Vec<TreeNode>,
    /// Rays recorded: more than `nodes` where they are too many to keep.
    pub recorded: u32,
    /// The pixel.
    pub texel: Texel,
    /// The arithmetic that was used.
    pub float: Float,
}

impl GpuRenderer {
    /// Trace the first sample of one pixel, and record its tree, with every effect simulated: the same bits as
    /// without those that the scene does not call for.
    ///
    /// # Errors
    /// As [`render`](crate::film::Renderer::render).
    pub fn trace_tree(
        &mut self,
        view: &View,
        settings: &Settings,
        [x, y]: [u32; 2],
    ) -> Result<GpuTree, GpuError> {
        let settings = Settings { aovs: true, samples: 1, ..*settings };
        let general = Plan::general(settings.depth);
        let plan = Plan { effects: general.effects.without(Effect::Adaptive), ..general };
        let float = if self.adapter().strict_float { settings.float } else { Float::Fast };
        let variant = Variant { tree: true, float, ..self.variant_of(&settings, &plan) };
        let view = View { crop: [x, y, 1, 1], samples: 1, ..*view };
        let job = self.prepare(&view, &variant)?;
        let mut frame = Frame {
            width: 1,
            height: 1,
            texels: Vec::new(),
            aovs: Some(Vec::new()),
            samples: SampleCounts::Same(1),
            float,
            rays: RayCounts::default(),
            times: TraceTimes::default(),
            complete: false,
        };
        let mut pace = Pace::new(job.blocks.count(), 1, variant.most_blocks(), job.context.adapter.kind);
        job.trace(&mut pace, &(), &mut frame)?;
        let (context, buffer, tree_at) = (job.context, &job.film.buffer, job.tree_at);
        let mut recorded = 0;
        context.read(buffer, tree_at..tree_at + 4, 4, |bytes| {
            recorded = bytemuck::pod_read_unaligned(bytes);
        })?;
        let kept = u64::from(recorded.min(TREE_NODES));
        let mut bytes = Vec::new();
        if kept > 0 {
            let start = tree_at + NODES_AT;
            let record = size_of::<TreeNode>() as u64;
            context
                .read(buffer, start..start + kept * record, record, |part| bytes.extend_from_slice(part))?;
        }
        Ok(GpuTree {
            nodes: bytemuck::pod_collect_to_vec(&bytes),
            recorded,
            texel: frame.texels.first().copied().unwrap_or_default(),
            float,
        })
    }
}
