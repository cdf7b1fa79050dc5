//! The contract both devices obey: `#[repr(C)]` records, shared constants, settings, effects.
//!
//! Every record here but [`Node`], which adapters get as [`WideNode`], has a WGSL struct of the same name in
//! `shaders/records.wgsl`; a test compares sizes and offsets. Every constant in [`constants`] is injected into the shaders; a test forbids repeating one.

mod adaptive;
pub mod constants;
mod effects;
mod flat_scene;
mod records;
mod settings;
mod tile;
mod tree;
mod view;

pub use adaptive::{Statistics, refinement_rounds};
pub use effects::{Effect, EffectChoice, EffectSet, Effects, Finding, Lights, Number, Numbers, Plan, Scan};
pub use flat_scene::{Body, FlatScene, FlatTexture};
pub use records::{Aov, Attribute, Light, Material, Node, Texel, Triangle, WideNode};
pub use settings::{Backend, Float, Intersector, Precision, Settings};
pub use tile::{FilmHead, Tile};
pub use tree::TreeNode;
pub use view::View;
