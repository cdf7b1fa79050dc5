//! The CPU twin of `shaders/`: same stems, same function names, same order of operations.
//!
//! Scalar and generic over [`Real`]: in f32 it gives the bits of a strict GPU, in f64 it is the judge. Nothing here
//! knows threads, devices or files.

pub mod adaptive;
pub mod background;
pub mod bvh;
pub mod camera;
pub mod film;
pub mod hash;
pub mod light;
pub mod material;
pub mod math;
pub mod media;
pub mod real;
pub mod record;
pub mod surface;
pub mod texture;
pub mod triangle;
pub mod vector;
pub mod whitted;
mod world;

pub use real::Real;
pub use vector::Vec3;
pub use world::{Simulation, Within, World};
