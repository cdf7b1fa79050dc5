#![doc = include_str!("ARCHITECTURE.md")]

pub mod bvh;
pub mod film;
pub mod layout;
pub mod scene;
