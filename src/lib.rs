#![doc = include_str!("ARCHITECTURE.md")]

pub mod film;
pub mod layout;
pub mod scene;
