//! The camera: from a target, or from a basis of its own.

use glam::DVec3;
use toml::Spanned;

use super::document::CameraTable;
use super::number::Vector;
use super::source::Source;
use super::table::Table;
use super::{Camera, Diagnostic};

/// How far a given basis may be from orthonormal, per scalar product.
const BASIS_TOLERANCE: f64 = 1e-3;
/// The least sine of the angle between `up` and the direction of view.
const MIN_UP_SINE: f64 = 1e-6;

/// Turn the table into a camera. A camera with a basis of its own has its pivot at distance 1 until the models
/// are known.
pub(super) fn camera(table: &Spanned<Table<CameraTable>>, source: &Source) -> Result<Camera, Diagnostic> {
    let span = table.span();
    let table = table.get_ref();
    match (&table.target, &table.right, &table.up, &table.forward) {
        (Some(target), None, _, None) => look_at(table, target, source),
        (None, Some(right), Some(up), Some(forward)) => from_basis(table, [right, up, forward], source),
        (Some(target), ..) => Err(Diagnostic::error("the camera has a target and a basis")
            .at(source.locate(target.span()))
            .hint("give `target` (and `up`), or all of `right`, `up` and `forward`")),
        (None, ..) => Err(Diagnostic::error("the camera looks nowhere")
            .at(source.locate(span))
            .hint("give `target` (and `up`), or all of `right`, `up` and `forward`")),
    }
}

fn look_at(table: &CameraTable, target: &Spanned<Vector<3>>, source: &Source) -> Result<Camera, Diagnostic> {
    let eye = DVec3::from(table.eye);
    let offset = DVec3::from(*target.get_ref()) - eye;
    let Some(forward) = offset.try_normalize() else {
        return Err(Diagnostic::error("the camera's eye and target are the same point")
            .at(source.locate(target.span())));
    };
    let up = table.up.as_ref().map_or(DVec3::Y, |up| DVec3::from(*up.get_ref()));
    let place = || source.locate(table.up.as_ref().map_or(target.span(), Spanned::span));
    let Some(up) = up.try_normalize() else {
        return Err(Diagnostic::error("the camera's up has no direction").at(place()));
    };
    let right = forward.cross(up);
    if right.length() < MIN_UP_SINE {
        return Err(Diagnostic::error("the camera's up is parallel to its direction of view")
            .at(place())
            .hint("looking straight up or down needs an `up` of its own, like [0, 0, -1]"));
    }
    let right = right.normalize();
    Ok(Camera {
        eye,
        right,
        up: right.cross(forward),
        forward,
        target_distance: offset.length(),
        fov_y: table.fov_y.value,
    })
}

/// Check a basis and make it exactly orthonormal: `forward` stays, `up` is turned the least.
fn from_basis(
    table: &CameraTable,
    axes: [&Spanned<Vector<3>>; 3],
    source: &Source,
) -> Result<Camera, Diagnostic> {
    let [right, up, forward] = axes.map(|axis| DVec3::from(*axis.get_ref()));
    let wrong = |axis: &Spanned<Vector<3>>, message: &str| {
        Err(Diagnostic::error(message)
            .at(source.locate(axis.span()))
            .hint("`right`, `up` and `forward` are unit vectors at right angles with right × up = −forward"))
    };
    for axis in axes {
        if (DVec3::from(*axis.get_ref()).length_squared() - 1.0).abs() > 2.0 * BASIS_TOLERANCE {
            return wrong(axis, "the camera's basis vector is not of length 1");
        }
    }
    if right.dot(up).abs().max(up.dot(forward).abs()) > BASIS_TOLERANCE {
        return wrong(axes[1], "the camera's up is not at right angles to the other two");
    }
    if right.dot(forward).abs() > BASIS_TOLERANCE {
        return wrong(axes[2], "the camera's forward is not at right angles to the other two");
    }
    if right.cross(up).dot(forward) > 0.0 {
        return wrong(axes[2], "the camera's basis is left-handed");
    }
    let forward = forward.normalize();
    let right = forward.cross(up).normalize();
    Ok(Camera {
        eye: table.eye.into(),
        right,
        up: right.cross(forward),
        forward,
        target_distance: 1.0,
        fov_y: table.fov_y.value,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::path::Path;

    use super::*;

    fn read(keys: &str) -> Result<Camera, Diagnostic> {
        let source = Source::new(Path::new("a.toml"), format!("[camera]\n{keys}"));
        let document = super::super::fault::parse(&source).unwrap();
        camera(&document.camera.unwrap(), &source)
    }

    fn fault(keys: &str) -> (String, u32, u32) {
        let diagnostic = read(keys).unwrap_err();
        let place = diagnostic.location.unwrap();
        (diagnostic.message, place.line, place.column)
    }

    #[test]
    fn a_target_gives_an_orthonormal_right_handed_basis() {
        let camera = read("eye = [3, 1.6, 5]\ntarget = [0, 0.6, 0]\nup = [0, 5, 0]").unwrap();
        assert!((camera.right.cross(camera.up) + camera.forward).length() < 1e-15);
        assert!((camera.forward * camera.target_distance - DVec3::new(-3.0, -1.0, -5.0)).length() < 1e-14);
        assert!(camera.up.y > 0.9 && camera.right.y.abs() < 1e-15);
        assert_eq!(camera.fov_y, 35.0);
    }

    #[test]
    fn a_camera_is_carried_round_its_target() {
        let camera = read("eye = [3, 1.6, 5]\ntarget = [1, 0.6, 0]").unwrap();
        let turned = camera.turned(90.0);
        assert!((turned.eye - DVec3::new(6.0, 1.6, -2.0)).length() < 1e-12, "{}", turned.eye);
        let target = turned.eye + turned.forward * turned.target_distance;
        assert!((target - DVec3::new(1.0, 0.6, 0.0)).length() < 1e-12);
        assert!((turned.right.cross(turned.up) + turned.forward).length() < 1e-12);
        assert_eq!(camera.turned(0.0), camera);
    }

    #[test]
    fn a_basis_is_kept_and_made_exact() {
        let camera =
            read("eye = [0, 0, 0]\nright = [1, 0.0005, 0]\nup = [0, 1, 0]\nforward = [0, 0, -1]").unwrap();
        assert_eq!((camera.right, camera.up, camera.forward), (DVec3::X, DVec3::Y, DVec3::NEG_Z));
    }

    #[test]
    fn impossible_cameras_are_located() {
        for (keys, message, line, column) in [
            ("eye = [1, 2, 3]\ntarget = [1, 2, 3]", "the camera's eye and target are the same point", 3, 10),
            (
                "eye = [0, 0, 0]\ntarget = [0, 3, 0]",
                "the camera's up is parallel to its direction of view",
                3,
                10,
            ),
            (
                "eye = [0, 0, 0]\ntarget = [0, 0, 1]\nup = [0, 0, -2]",
                "the camera's up is parallel to its direction of view",
                4,
                6,
            ),
            ("eye = [0, 0, 0]\ntarget = [0, 0, 1]\nup = [0, 0, 0]", "the camera's up has no direction", 4, 6),
            ("eye = [0, 0, 0]", "the camera looks nowhere", 1, 1),
            ("eye = [0, 0, 0]\nright = [1, 0, 0]\nup = [0, 1, 0]", "the camera looks nowhere", 1, 1),
            (
                "eye = [0, 0, 0]\nright = [1, 0, 0]\ntarget = [0, 0, 1]",
                "the camera has a target and a basis",
                4,
                10,
            ),
        ] {
            assert_eq!(fault(keys), (message.to_owned(), line, column), "{keys}");
        }
    }

    #[test]
    fn bases_that_are_not_orthonormal_are_located() {
        for (right, up, forward, message, line) in [
            ("[2, 0, 0]", "[0, 1, 0]", "[0, 0, -1]", "not of length 1", 3),
            ("[1, 0, 0]", "[0.6, 0.8, 0]", "[0, 0, -1]", "up is not at right angles", 4),
            ("[1, 0, 0]", "[0, 1, 0]", "[0.6, 0, -0.8]", "forward is not at right angles", 5),
            ("[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]", "left-handed", 5),
        ] {
            let keys = format!("eye = [0, 0, 0]\nright = {right}\nup = {up}\nforward = {forward}");
            let (found, at, _) = fault(&keys);
            assert!(found.contains(message) && at == line, "{found} in line {at}");
        }
    }
}
