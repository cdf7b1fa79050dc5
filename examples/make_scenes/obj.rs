//! Wavefront OBJ text with few digits.

use std::fmt::Write as _;

use glam::{DVec2, DVec3};

use crate::mesh::Mesh;

/// Digits after the point: 10 µm for a scene unit of a metre.
const DECIMALS: i32 = 5;

/// The mesh as the file will hold it: its coordinates rounded.
pub(crate) fn rounded(mesh: &Mesh) -> Mesh {
    let scale = 10_f64.powi(DECIMALS);
    mesh.clone().mapped(|p| (p * scale).round() / scale)
}

/// A part of an OBJ file.
#[derive(Debug)]
pub(crate) struct Part<'a> {
    /// The object's name and its material in the MTL file.
    pub(crate) name: &'a str,
    pub(crate) mesh: &'a Mesh,
    /// Whether the file carries normals that round the edges.
    pub(crate) smooth: bool,
}

/// One unnamed mesh under a comment.
pub(crate) fn text(comment: &str, mesh: &Mesh) -> String {
    let mut out = format!("# {comment}\n");
    write_mesh(&mut out, mesh, &[], &mut [1; 3]);
    out
}

/// Several objects, each in the material of its own name.
pub(crate) fn text_with_materials(comment: &str, library: &str, parts: &[Part]) -> String {
    let mut out = format!("# {comment}\nmtllib {library}\n");
    let mut first = [1; 3];
    for part in parts {
        let _ = writeln!(out, "o {0}\nusemtl {0}", part.name);
        let normals = if part.smooth { part.mesh.smooth_normals() } else { Vec::new() };
        write_mesh(&mut out, part.mesh, &normals, &mut first);
    }
    out
}

/// Writes the mesh; `first` are the next free numbers of a position, a texture coordinate and a normal.
fn write_mesh(out: &mut String, mesh: &Mesh, normals: &[DVec3], first: &mut [u32; 3]) {
    for DVec3 { x, y, z } in &mesh.positions {
        let _ = writeln!(out, "v {} {} {}", digits(*x), digits(*y), digits(*z));
    }
    for DVec2 { x, y } in &mesh.uvs {
        let _ = writeln!(out, "vt {} {}", digits(*x), digits(*y));
    }
    for DVec3 { x, y, z } in normals {
        let _ = writeln!(out, "vn {x:.3} {y:.3} {z:.3}");
    }
    for t in &mesh.triangles {
        out.push('f');
        for &i in t {
            let [v, vt, vn] = first.map(|f| i + f);
            let _ = match (mesh.uvs.is_empty(), normals.is_empty()) {
                (true, true) => write!(out, " {v}"),
                (false, true) => write!(out, " {v}/{vt}"),
                (true, false) => write!(out, " {v}//{vn}"),
                (false, false) => write!(out, " {v}/{vt}/{vn}"),
            };
        }
        out.push('\n');
    }
    for (first, count) in first.iter_mut().zip([mesh.positions.len(), mesh.uvs.len(), normals.len()]) {
        *first += count as u32;
    }
}

/// Fixed point without trailing zeros or a lone sign.
fn digits(x: f64) -> String {
    let text = format!("{x:.*}", DECIMALS as usize);
    let text = text.trim_end_matches('0').trim_end_matches('.');
    match text {
        "-0" | "" => "0".to_owned(),
        _ => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_few() {
        assert_eq!(digits(1.0), "1");
        assert_eq!(digits(-0.000_001), "0");
        assert_eq!(digits(-0.25), "-0.25");
        assert_eq!(digits(10.0), "10");
        assert_eq!(digits(0.0), "0");
    }
}
