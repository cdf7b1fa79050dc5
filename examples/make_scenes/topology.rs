//! What a mesh must be before it is written: closed, oriented, without slivers of no area.

use std::collections::HashMap;
use std::fmt;

use crate::mesh::Mesh;

/// Counts of a closed mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Topology {
    /// Connected pieces of surface.
    pub(crate) shells: usize,
    /// V − E + F: 2 for each sphere-like shell, 0 for a torus.
    pub(crate) euler: i64,
}

/// Why a mesh is no solid.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Fault {
    /// A directed edge that is not met by exactly one in the opposite direction.
    Edge([u32; 2]),
    /// A triangle without area.
    Degenerate([u32; 3]),
    /// The solid is inside-out.
    Volume(f64),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Edge([a, b]) => {
                write!(f, "edge {a}–{b} is not shared by two triangles in opposite directions")
            }
            Self::Degenerate(t) => write!(f, "triangle {t:?} has no area"),
            Self::Volume(v) => write!(f, "its volume is {v}, so it is inside-out"),
        }
    }
}

impl std::error::Error for Fault {}

impl Topology {
    /// Proves that the mesh is a solid: every directed edge once, its opposite once, positive area and volume.
    pub(crate) fn of(mesh: &Mesh) -> Result<Self, Fault> {
        let mut edges: HashMap<[u32; 2], u32> = HashMap::with_capacity(mesh.triangles.len() * 3);
        for &t in &mesh.triangles {
            let [a, b, c] = mesh.corners(t);
            if (b - a).cross(c - a).length_squared() <= 0.0 {
                return Err(Fault::Degenerate(t));
            }
            for [i, j] in [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]] {
                *edges.entry([i, j]).or_default() += 1;
            }
        }
        for (&[i, j], &count) in &edges {
            if count != 1 || !edges.contains_key(&[j, i]) {
                return Err(Fault::Edge([i.min(j), i.max(j)]));
            }
        }
        if mesh.volume() <= 0.0 {
            return Err(Fault::Volume(mesh.volume()));
        }
        let used = used_vertices(mesh);
        let euler = used as i64 - (edges.len() / 2) as i64 + mesh.triangles.len() as i64;
        Ok(Self { shells: shells(mesh), euler })
    }
}

fn used_vertices(mesh: &Mesh) -> usize {
    let mut used = vec![false; mesh.positions.len()];
    mesh.triangles.as_flattened().iter().for_each(|&i| used[i as usize] = true);
    used.into_iter().filter(|&u| u).count()
}

/// Connected components by union-find.
fn shells(mesh: &Mesh) -> usize {
    let mut parent: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    fn root(parent: &mut [u32], mut i: u32) -> u32 {
        while parent[i as usize] != i {
            parent[i as usize] = parent[parent[i as usize] as usize];
            i = parent[i as usize];
        }
        i
    }
    let mut used = vec![false; parent.len()];
    for t in &mesh.triangles {
        t.iter().for_each(|&i| used[i as usize] = true);
        for pair in [[t[0], t[1]], [t[1], t[2]]] {
            let [a, b] = pair.map(|i| root(&mut parent, i));
            parent[a as usize] = b;
        }
    }
    (0..parent.len()).filter(|&i| used[i] && parent[i] == i as u32).count()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::shapes::icosphere;

    #[test]
    fn a_sphere_has_one_shell_and_euler_characteristic_two() {
        let sphere = icosphere(2);
        assert_eq!(Topology::of(&sphere).unwrap(), Topology { shells: 1, euler: 2 });
    }

    #[test]
    fn a_bubble_adds_a_shell() {
        let mut mesh = icosphere(2);
        mesh.append(&icosphere(1).mapped(|p| 0.5 * p).inverted());
        assert_eq!(Topology::of(&mesh).unwrap(), Topology { shells: 2, euler: 4 });
    }

    #[test]
    fn a_missing_triangle_is_found() {
        let mut mesh = icosphere(1);
        mesh.triangles.pop();
        assert!(matches!(Topology::of(&mesh), Err(Fault::Edge(_))));
    }

    #[test]
    fn a_turned_triangle_is_found() {
        let mut mesh = icosphere(1);
        mesh.triangles[3].swap(0, 1);
        assert!(matches!(Topology::of(&mesh), Err(Fault::Edge(_))));
    }

    #[test]
    fn an_inside_out_solid_is_found() {
        assert!(matches!(Topology::of(&icosphere(1).inverted()), Err(Fault::Volume(_))));
    }

    #[test]
    fn a_flat_triangle_is_found() {
        let mut mesh = icosphere(0);
        mesh.positions[mesh.triangles[0][1] as usize] = mesh.positions[mesh.triangles[0][0] as usize];
        assert!(matches!(Topology::of(&mesh), Err(Fault::Degenerate(_))));
    }
}
