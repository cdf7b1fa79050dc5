//! The pipelines of a renderer, by variant: compiled when they are needed, or ahead on another thread.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use super::context::Context;
use super::pipeline::{Compiled, compile};
use super::{GpuError, Source, Variant};

/// File and name of the entry point.
const ENTRY: (&str, &str) = ("render", "render");

/// The pipelines of a renderer. A clone shares them.
#[derive(Clone)]
pub(super) struct Pipelines {
    context: Context,
    layout: wgpu::BindGroupLayout,
    sources: &'static [Source<'static>],
    compiled: Arc<Mutex<HashMap<Variant, Compiled>>>,
}

impl Pipelines {
    /// None yet, to be assembled out of these shader files.
    pub(super) fn new(
        context: &Context,
        layout: &wgpu::BindGroupLayout,
        sources: &'static [Source<'static>],
    ) -> Self {
        Self { context: context.clone(), layout: layout.clone(), sources, compiled: Arc::default() }
    }

    /// The variant's pipeline if it is compiled.
    pub(super) fn get(&self, variant: &Variant) -> Option<Compiled> {
        self.compiled.lock().unwrap_or_else(PoisonError::into_inner).get(variant).cloned()
    }

    /// The variant's pipeline, compiled now where it is not there. Other threads go on with theirs meanwhile; two that
    /// compile the same do so side by side, and the first wins.
    pub(super) fn compile(&self, variant: &Variant) -> Result<Compiled, GpuError> {
        if let Some(pipeline) = self.get(variant) {
            return Ok(pipeline);
        }
        let pipeline = compile(&self.context, &self.layout, self.sources, ENTRY, variant)?;
        self.context.pipeline_cache.save();
        let mut compiled = self.compiled.lock().unwrap_or_else(PoisonError::into_inner);
        Ok(compiled.entry(*variant).or_insert(pipeline).clone())
    }
}
