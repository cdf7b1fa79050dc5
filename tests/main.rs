//! The integration tests: one binary, one module per concern.

mod cli;
mod closed_forms;
mod fuzz;
mod layering;
mod lockstep;
mod properties;
mod scenes;
mod selftest;
