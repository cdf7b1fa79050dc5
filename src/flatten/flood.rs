//! Consistent winding: the first face of a shell tells all others which side is out.

use super::edges::{self, Sides};

/// A consistent winding of every shell.
pub(super) struct Winding {
    /// For each triangle its shell; [`edges::NONE`] for triangles without area.
    pub(super) shell: Vec<u32>,
    /// Whether the triangle must be reversed to agree with most of its shell.
    pub(super) turned: Vec<bool>,
    /// Number of shells.
    pub(super) shells: u32,
    /// How many triangles are reversed.
    pub(super) rewound: usize,
}

impl Winding {
    /// Spread the first triangle's winding over each shell; `None` for a one-sided surface.
    pub(super) fn flood(triangles: &[[u32; 3]], sides: &Sides) -> Option<Self> {
        let mut winding = Self {
            shell: vec![edges::NONE; triangles.len()],
            turned: vec![false; triangles.len()],
            shells: 0,
            rewound: 0,
        };
        for first in 0..triangles.len() {
            if winding.shell[first] == edges::NONE && edges::is_proper(triangles[first]) {
                winding.flood_shell(first, triangles, sides)?;
            }
        }
        Some(winding)
    }

    fn flood_shell(&mut self, first: usize, triangles: &[[u32; 3]], sides: &Sides) -> Option<()> {
        let mut members = vec![first];
        self.shell[first] = self.shells;
        let mut next = 0;
        while let Some(&triangle) = members.get(next) {
            next += 1;
            for side in triangle * 3..triangle * 3 + 3 {
                let partner = sides.partner[side];
                let neighbour = partner as usize / 3;
                // Agreeing sides keep the winding, others turn it.
                let turned = self.turned[triangle] == edges::agree(triangles, side as u32, partner);
                if self.shell[neighbour] == edges::NONE {
                    self.shell[neighbour] = self.shells;
                    self.turned[neighbour] = turned;
                    members.push(neighbour);
                } else if self.turned[neighbour] != turned {
                    return None;
                }
            }
        }
        self.keep_majority(&members);
        self.shells += 1;
        Some(())
    }

    /// The winding of most triangles of a shell is taken for the one that was meant.
    fn keep_majority(&mut self, members: &[usize]) {
        let turned = members.iter().filter(|&&triangle| self.turned[triangle]).count();
        if turned * 2 > members.len() {
            members.iter().for_each(|&triangle| self.turned[triangle] = !self.turned[triangle]);
        }
        self.rewound += turned.min(members.len() - turned);
    }
}
