//! Makes every mesh, texture and environment under `scenes/`; the scene files there are written by hand.
//!
//!     cargo run --release --example make_scenes              # all of them
//!     cargo run --release --example make_scenes -- ice/      # those whose path contains a word
//!
//! The same bytes come out of every run. A mesh that is not a closed, consistently oriented solid is not written.

mod checker;
mod city;
mod field;
mod goblet;
mod ice;
mod mesh;
mod noise;
mod obj;
mod panorama;
mod prism;
mod product;
mod shapes;
mod still_life;
mod studio;
mod surface_nets;
mod table;
mod topology;

use std::error::Error;
use std::path::Path;

use product::Product;

fn main() -> Result<(), Box<dyn Error>> {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    for product in products() {
        if wanted.is_empty() || wanted.iter().any(|word| product.path.contains(word)) {
            product.write(&folder)?;
        }
    }
    Ok(())
}

/// Everything that is made.
fn products() -> Vec<Product> {
    [
        ice::products(),
        table::products(),
        studio::products(),
        goblet::products(),
        checker::products(),
        prism::products(),
        city::products(),
        still_life::products(),
    ]
    .concat()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn folder() -> std::path::PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")
    }

    #[test]
    fn every_product_lies_in_the_repository_and_meshes_stay_small() {
        let mut meshes = 0;
        for product in products() {
            let size = std::fs::metadata(folder().join(product.path)).unwrap().len();
            if product.path.ends_with(".obj") {
                meshes += size;
            }
        }
        assert!(meshes <= 6_000_000, "{meshes} bytes");
    }

    #[test]
    fn paths_are_unique() {
        let mut paths: Vec<&str> = products().iter().map(|p| p.path).collect();
        paths.sort_unstable();
        paths.dedup();
        assert_eq!(paths.len(), products().len());
    }
}
