// A record of words, read and written one after the other: the harness of the probes. See src/gpu/probe.rs.

import package::real::{real, vec3r};

// Which records a dispatch works on, and all of them.
struct Records {
    first: u32, end: u32, stride: u32, reserved: u32,
    words: array<u32>,
}

@group(0) @binding(7) var<storage, read_write> records: Records;

var<private> reading: u32;
var<private> writing: u32;

// Go to the record of an invocation; false if there is none.
fn begin(invocation: u32) -> bool {
    let record = records.first + invocation;
    reading = record * records.stride;
    writing = reading;
    return record < records.end;
}

// The next word.
fn take_word() -> u32 {
    reading++;
    return records.words[reading - 1u];
}

// The next number.
fn take() -> real {
    return real(bitcast<f32>(take_word()));
}

// The next vector.
fn take3() -> vec3r {
    let x = take();
    let y = take();
    let z = take();
    return vec3r(x, y, z);
}

// Write behind what was taken, not over it: the record can be run again.
fn put_behind() {
    writing = reading;
}

// Write a word over the next word; all is taken by then.
fn put_word(word: u32) {
    records.words[writing] = word;
    writing++;
}

// Write a number.
fn put(x: real) {
    put_word(bitcast<u32>(f32(x)));
}

// Write a vector.
fn put3(v: vec3r) {
    put(v.x);
    put(v.y);
    put(v.z);
}

// Write a truth.
fn put_flag(flag: bool) {
    put_word(select(0u, 1u, flag));
}
