#![doc = include_str!("ARCHITECTURE.md")]

pub mod bench;
pub mod bvh;
pub mod cli;
pub mod cpu;
pub mod film;
pub mod flatten;
pub mod gpu;
pub mod kernel;
pub mod layout;
pub mod plot;
pub mod scene;
pub mod selftest;
pub mod study;
pub mod trace;
#[cfg(feature = "viewer")]
pub mod viewer;
