// Stop 1 of 7: camera. Twin of src/kernel/camera.rs.

import package::real::{real, vec3r};
import package::math::unit3;
import package::bindings::frame;

// Unit direction from the eye through the point (x, y) of the picture, in pixels from its top left corner.
fn primary_ray(x: real, y: real) -> vec3r {
    let sx = (x + x) / real(i32(frame.view.width)) - 1.0;
    let sy = 1.0 - (y + y) / real(i32(frame.view.height));
    let forward = vec3r(frame.view.forward);
    return unit3(forward + vec3r(frame.view.right) * sx + vec3r(frame.view.up) * sy);
}
