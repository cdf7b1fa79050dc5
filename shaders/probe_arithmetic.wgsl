// Entry point: what the driver makes of single operations and of sums of products. Twin of src/selftest/arithmetic.rs.

import package::probe::{begin, put, take};
import package::constants::PROBE_GROUP;

@compute @workgroup_size(PROBE_GROUP)
fn probe_arithmetic(@builtin(global_invocation_id) id: vec3u) {
    if !begin(id.x) {
        return;
    }
    let a = take();
    let b = take();
    let c = take();
    let d = take();
    let tiny = take();
    let zero = take();
    let positive = abs(a);
    // Single operations.
    put(a / b);
    put(sqrt(positive));
    put(inverseSqrt(positive));
    put(exp(c));
    put(pow(positive, c));
    put(fma(a, b, d));
    // What must not be rewritten.
    put(a * b - d * b);
    put(a * b + a * d);
    put((a + b) - a);
    put(sqrt(positive) * sqrt(positive));
    put(a / 3.0);
    // What leaves the normal numbers.
    put(tiny * 0.5);
    put(zero * -1.0);
}
