#![doc = include_str!("ARCHITECTURE.md")]

pub mod cpu;
pub mod film;
pub mod kernel;
pub mod layout;
pub mod scene;
