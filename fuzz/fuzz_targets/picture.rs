//! PNG, JPEG, HDR and EXR pictures, from bytes to a traced picture.

#![no_main]

#[path = "../../tests/fuzz/targets.rs"]
mod targets;

use libfuzzer_sys::fuzz_target;
use targets::{Feeder, SMALL};

thread_local!(static FEEDER: Feeder = Feeder::new("picture", SMALL));

fuzz_target!(|input: &[u8]| {
    FEEDER.with(|feeder| feeder.feed(input));
});
