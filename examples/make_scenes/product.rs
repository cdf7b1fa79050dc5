//! A file that the generator makes, and how it is checked and written.

use std::error::Error;
use std::path::Path;

use image::{Rgb, Rgb32FImage, RgbImage};

use crate::mesh::Mesh;
use crate::obj;
use crate::topology::Topology;

/// A file to be made: nothing is computed before it is written.
#[derive(Debug, Clone)]
pub(crate) struct Product {
    /// Below `scenes/`.
    pub(crate) path: &'static str,
    pub(crate) make: Make,
}

/// What to make.
#[derive(Debug, Clone)]
pub(crate) enum Make {
    /// An OBJ file of one closed solid, with a comment on what it is.
    Solid(&'static str, fn() -> Mesh),
    /// Text as it is.
    Text(fn() -> String),
    /// An 8-bit sRGB picture.
    Png(fn() -> RgbImage),
    /// Linear radiance.
    Hdr(fn() -> Rgb32FImage),
}

impl Product {
    /// A closed solid.
    pub(crate) fn solid(path: &'static str, comment: &'static str, make: fn() -> Mesh) -> Self {
        Self { path, make: Make::Solid(comment, make) }
    }

    /// Makes the file, checks it and says what it holds.
    pub(crate) fn write(&self, folder: &Path) -> Result<(), Box<dyn Error>> {
        let path = folder.join(self.path);
        if let Some(parent) = path.parent() {
            std::fs::create_dir_all(parent)?;
        }
        let what = match &self.make {
            Make::Solid(comment, make) => {
                let mesh = obj::rounded(&make());
                let topology = Topology::of(&mesh).map_err(|fault| format!("{}: {fault}", self.path))?;
                std::fs::write(&path, obj::text(comment, &mesh))?;
                let (triangles, Topology { shells, euler }) = (mesh.triangles.len(), topology);
                format!("{triangles} triangles, {shells} shells, Euler characteristic {euler}")
            }
            Make::Text(make) => {
                std::fs::write(&path, make())?;
                "text".to_owned()
            }
            Make::Png(make) => {
                let picture = make();
                picture.save(&path)?;
                format!("{} × {}", picture.width(), picture.height())
            }
            Make::Hdr(make) => {
                let picture = make();
                let pixels: Vec<Rgb<f32>> = picture.pixels().copied().collect();
                let file = std::io::BufWriter::new(std::fs::File::create(&path)?);
                let (width, height) = (picture.width() as usize, picture.height() as usize);
                image::codecs::hdr::HdrEncoder::new(file).encode(&pixels, width, height)?;
                format!("{width} × {height}")
            }
        };
        println!("{:8} bytes  {}: {what}", std::fs::metadata(&path)?.len(), self.path);
        Ok(())
    }
}
