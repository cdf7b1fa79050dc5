//! The integration tests: one binary, one module per concern.

mod cli;
mod effects;
mod fuzz;
mod layering;
mod lockstep;
mod properties;
mod scenes;
mod selftest;
mod study;
mod theory;
mod trace;
#[cfg(feature = "viewer")]
mod viewer;
