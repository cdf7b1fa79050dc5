//! Files that ask for more than they hold: each is refused with a message that says so.

use std::fmt::Write;

/// A file, the reader that is fed it, and a part of its answer.
pub(super) struct Attack {
    pub(super) name: &'static str,
    pub(super) target: &'static str,
    pub(super) input: Vec<u8>,
    pub(super) says: &'static str,
}

fn attack(name: &'static str, target: &'static str, input: impl Into<Vec<u8>>, says: &'static str) -> Attack {
    Attack { name, target, input: input.into(), says }
}

/// A scene of one shape.
fn shape(shape: &str, keys: &str) -> String {
    format!("[material.m]\n[[model]]\nmaterial = \"m\"\nshape = {{ {shape} }}\n{keys}\n")
}

/// Text around many copies of something.
fn many(before: &str, part: &str, count: usize, after: &str) -> String {
    [before, &part.repeat(count), after].concat()
}

/// A PNG that is nothing but a header: the size in pixels.
fn png(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = include_bytes!("corpus/picture/rgb8.png").to_vec();
    // Behind the signature, the length and the letters of the first chunk.
    bytes[16..20].copy_from_slice(&width.to_be_bytes());
    bytes[20..24].copy_from_slice(&height.to_be_bytes());
    super::mutate::png::mend(&mut bytes);
    bytes
}

fn hdr(size: &str) -> String {
    format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{size}\n")
}

/// A baseline JPEG with other sizes in its frame header.
fn jpeg(height: u16, width: u16) -> Vec<u8> {
    let mut bytes = include_bytes!("corpus/picture/baseline.jpg").to_vec();
    let frame = bytes.windows(2).position(|marker| marker == [0xff, 0xc0]).expect("a frame header");
    bytes[frame + 5..frame + 7].copy_from_slice(&height.to_be_bytes());
    bytes[frame + 7..frame + 9].copy_from_slice(&width.to_be_bytes());
    bytes
}

/// An uncompressed EXR with another right lower corner of its data window.
fn exr(right: i32, bottom: i32) -> Vec<u8> {
    let mut bytes = include_bytes!("corpus/picture/none.exr").to_vec();
    let name = b"dataWindow\0box2i\0";
    let window = bytes.windows(name.len()).position(|part| part == name).expect("a data window");
    // Behind the name: the length of the value, then left, top, right and bottom.
    let corner = window + name.len() + 12;
    bytes[corner..corner + 4].copy_from_slice(&right.to_le_bytes());
    bytes[corner + 4..corner + 8].copy_from_slice(&bottom.to_le_bytes());
    bytes
}

/// A mesh of one face, of so many corners.
fn polygon(corners: usize) -> String {
    let mut text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf".to_owned();
    (0..corners).for_each(|corner| write!(text, " {}", corner % 3 + 1).expect("text"));
    text
}

/// Every attack.
pub(super) fn all() -> Vec<Attack> {
    let box_ = "box = { size = [1, 1, 1] }";
    let copies = |count: &str| shape(box_, &format!("repeat = {{ count = {count}, step = [2, 2, 2] }}"));
    vec![
        attack(
            "a million copies along each axis",
            "scene",
            copies("[1000000, 1000000, 1000000]"),
            "the most is 33554432",
        ),
        attack("a thousand million copies", "scene", copies("[1000000000, 1, 1]"), "from 1 to 1000000"),
        attack(
            "more copies than an integer holds",
            "scene",
            copies("[99999999999999999999, 1, 1]"),
            "scene.toml:5",
        ),
        attack(
            "a sphere of level 99",
            "scene",
            shape("sphere = { radius = 1, level = 99 }", ""),
            "from 0 to 9",
        ),
        attack(
            "twenty of the finest spheres",
            "scene",
            many(
                "[material.m]\n",
                "[[model]]\nmaterial = 'm'\nshape = { sphere = { radius = 1, level = 9 } }\n",
                20,
                "",
            ),
            "the most is 33554432",
        ),
        attack("arrays within arrays", "scene", many("a = ", "[", 1 << 20, ""), "scene.toml:1"),
        attack(
            "closed arrays within arrays",
            "scene",
            "[".repeat(50_000) + &"]".repeat(50_000),
            "scene.toml:1",
        ),
        attack("tables within tables", "scene", many("a = ", "{ a = ", 1 << 18, ""), "scene.toml:1"),
        attack("a key of many parts", "scene", many("a", ".a", 1 << 20, " = 1"), "scene.toml:1"),
        attack("a table of many parts", "scene", many("[a", ".a", 1 << 20, "]"), "scene.toml:1"),
        attack("a string without end", "scene", many("[camera]\neye = \"", "a", 1 << 20, ""), "scene.toml:2"),
        attack("a file of zeros", "scene", vec![0; 1 << 20], "scene.toml:1"),
        attack("a file beyond the limit", "scene", vec![b'\n'; (1 << 24) + 1], "larger than 16 MiB"),
        attack(
            "a million lights",
            "scene",
            many("", "[[light]]\nposition = [0, 0, 0]\n", 1_000_000, ""),
            "larger than 16 MiB",
        ),
        attack(
            "as many models without shape as a file holds",
            "scene",
            many("", "[[model]]\n", (1 << 24) / 10, ""),
            "the model has neither a mesh nor a shape",
        ),
        attack(
            "thousands of transmissive bodies",
            "scene",
            many(
                "[material.m]\ntransmission = 1.0\n",
                "[[model]]\nmaterial = 'm'\nshape = { box = { size = [1, 1, 1] } }\n",
                10_000,
                "",
            ),
            "10000 bodies transmit light",
        ),
        attack("an index beyond 64 bits", "obj", "v 0 0 0\nf 1 99999999999999999999 1\n", "mesh.obj:2:5"),
        attack(
            "an index beyond 32 bits",
            "obj",
            "v 0 0 0\nf 1 4294967297 1\n",
            "there is no vertex 4294967297",
        ),
        attack(
            "the least index",
            "obj",
            "v 0 0 0\nf 1 -9223372036854775808 1\n",
            "there is no vertex -922337",
        ),
        attack("a face of a million corners", "obj", polygon(1 << 20), "the most is 16384"),
        attack(
            "a library a line",
            "obj",
            many("", "mtllib mesh.mtl\n", 100_000, ""),
            "too many material libraries",
        ),
        attack("a line without end", "obj", many("v 0 0 0\nv", " 0", 1 << 22, " x"), "`x` is not a number"),
        attack(
            "a million continued lines",
            "obj",
            many("v 0 0", " \\\n", 1 << 20, ""),
            "`v` needs 3 numbers",
        ),
        attack("nothing but backslashes", "obj", many("", "\\\n", 1 << 22, ""), "mesh.obj"),
        attack("a number of a million digits", "obj", many("v 0 0 ", "9", 1 << 20, ""), "mesh.obj:1:7"),
        attack(
            "a name of a million letters",
            "mtl",
            many("newmtl ", "a", 1 << 20, ""),
            "there is no material `glass`",
        ),
        attack("a library of zeros", "mtl", vec![0; 1 << 20], "there is no material `glass`"),
        attack(
            "a million materials",
            "mtl",
            many("", "newmtl a\nKd 1 1 1\n", 1_000_000, ""),
            "there is no material",
        ),
        attack("a PNG of 60000 × 60000", "picture", png(60_000, 60_000), "cannot decode"),
        attack("a PNG of 16000 × 16000", "picture", png(16_000, 16_000), "the most is 33554432"),
        attack("a PNG of 8000 × 4000 without data", "picture", png(8000, 4000), "cannot decode"),
        attack("a PNG without pixels", "picture", png(0, 4000), "picture.png"),
        attack("an HDR of 60000 × 60000", "picture", hdr("-Y 60000 +X 60000"), "picture.png"),
        attack("an HDR of 8000 × 4000 without data", "picture", hdr("-Y 8000 +X 4000"), "cannot decode"),
        attack("an HDR beyond 32 bits", "picture", hdr("-Y 4294967297 +X 4294967297"), "cannot decode"),
        attack("an HDR of less than nothing", "picture", hdr("-Y -5 +X 8"), "cannot decode"),
        attack("a JPEG of 65535 × 65535", "picture", jpeg(u16::MAX, u16::MAX), "picture.png"),
        attack("an EXR of 2^31 × 2^31", "picture", exr(i32::MAX, i32::MAX), "cannot decode"),
        attack("an EXR that ends before it starts", "picture", exr(i32::MIN, -1), "cannot decode"),
        attack("an EXR of 8000 × 4000 with the data of 12 × 6", "picture", exr(7999, 3999), "cannot decode"),
    ]
}
