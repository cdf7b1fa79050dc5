// The number that the kernel computes in, and selects on it. Twin of src/kernel/real.rs.

@if(f64) alias real = f64;
@if(!f64) alias real = f32;
alias vec3r = vec3<real>;
alias vec4r = vec4<real>;

// The lesser; `b` where they are equal.
fn least(a: real, b: real) -> real {
    return select(b, a, a < b);
}

// The greater; `b` where they are equal.
fn greatest(a: real, b: real) -> real {
    return select(b, a, a > b);
}
