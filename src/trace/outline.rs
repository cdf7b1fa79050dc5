//! The tree as indented lines.

use super::{End, Node, Tree};

/// One line a ray, indented below the ray that it came from.
#[must_use]
pub fn outline(tree: &Tree) -> String {
    let children = tree.children();
    let mut text = String::new();
    // Deepest trees have 65 levels, but many rays: a stack of our own all the same.
    let mut waiting = vec![(0, String::new(), true)];
    while let Some((id, indent, is_last)) = waiting.pop() {
        let Some(node) = tree.nodes.get(id) else { break };
        let (branch, below) = match (node.parent, is_last) {
            (None, _) => ("", ""),
            (Some(_), false) => ("├─ ", "│  "),
            (Some(_), true) => ("└─ ", "   "),
        };
        text += &format!("{indent}{branch}{}\n", line(node));
        let indent = indent + below;
        for (index, &child) in children[id].iter().enumerate().rev() {
            waiting.push((child, indent.clone(), index + 1 == children[id].len()));
        }
    }
    text
}

/// A ray in one line.
pub(super) fn line(node: &Node) -> String {
    let mut parts = vec![format!("{} {}", node.id, node.kind)];
    if let Some(hit) = &node.hit {
        parts.push(format!("{} from {} at {}", hit.body, hit.side, vector(hit.point)));
        parts.push(if hit.before == hit.behind {
            format!("in {}", hit.before)
        } else {
            format!("{} → {}", hit.before, hit.behind)
        });
        parts.push(format!("{:.2}°", hit.angle_deg));
        if hit.is_total {
            parts.push("total reflection".to_owned());
        } else if let Some(reflectance) = hit.reflectance {
            parts.push(format!("R {}", figure(reflectance)));
        }
    }
    parts.push(format!("weight {}", colour(node.weight)));
    if node.contribution != [0.0; 3] {
        parts.push(format!("adds {}", colour(node.contribution)));
    }
    if node.end != End::Surface {
        parts.push(node.end.words().to_owned());
    }
    parts.join(", ")
}

/// Three digits.
fn figure(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        v if v >= 1e-3 => format!("{value:.4}"),
        _ => format!("{value:.2e}"),
    }
}

/// One figure where all channels are the same.
fn colour(rgb: [f32; 3]) -> String {
    let words = rgb.map(|v| figure(f64::from(v)));
    if words[0] == words[1] && words[1] == words[2] { words[0].clone() } else { words.join(" ") }
}

fn vector(v: [f32; 3]) -> String {
    format!("({:.4}, {:.4}, {:.4})", v[0], v[1], v[2])
}
