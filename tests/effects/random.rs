//! Random scenes: a few solids of any matter, apart or into each other, under any lights.

/// A scene file; the same for the same number.
pub(super) fn scene(number: u32) -> String {
    let mut random = Random(number.wrapping_mul(0x9e37_79b9) ^ 0x5bd1_e995);
    let mut text = String::from(
        "[camera]\neye = [0.4, 1.2, 6]\ntarget = [0, 0, 0]\nfov_y = 40\n\
         [render]\nsize = [16, 12]\ndepth = 7\ncutoff = 1e-3\nsamples = 1\n\
         [ambient]\ncolor = [1.0, 1.0, 1.0]\nintensity = 0.2\n\
         [background]\nzenith = [0.1, 0.3, 0.9]\nhorizon = [1.0, 0.7, 0.4]\n",
    );
    for _ in 0..random.below(4) {
        let falloff = random.pick(&["none", "inverse-square"]);
        let [x, y, z] = [0; 3].map(|_| random.within(-5.0, 5.0));
        text += &format!(
            "[[light]]\nposition = [{x}, {y}, {z}]\ncolor = [1.0, 0.9, 0.8]\nfalloff = \"{falloff}\"\n"
        );
    }
    for model in 0..1 + random.below(5) {
        text += &material(model, &mut random);
        text += &solid(model, &mut random);
    }
    text
}

fn material(model: u32, random: &mut Random) -> String {
    let mut text = format!("[material.m{model}]\nior = {}\n", random.pick(&["1.0", "1.31", "1.5"]));
    if random.below(2) == 0 {
        text += "diffuse = { color = [0.8, 0.5, 0.3], k = 0.6 }\n";
    }
    if random.below(3) == 0 {
        text += "specular = { k = 0.5, shininess = 40 }\n";
    }
    if random.below(2) == 0 {
        text += &format!("reflection = {}\n", random.pick(&["0.3", "0.9", "1.0"]));
    }
    if random.below(2) == 0 {
        text += &format!("transmission = {}\n", random.pick(&["0.5", "0.7", "1.0"]));
        if random.below(2) == 0 {
            text += "absorption = [0.3, 0.0, 0.1]\n";
        }
    }
    if random.below(2) == 0 {
        text += "fresnel = true\n";
    }
    text
}

fn solid(model: u32, random: &mut Random) -> String {
    let shape = random.pick(&[
        "{ sphere = { radius = 0.7, level = 2 } }",
        "{ box = { size = [1, 1.2, 0.8] } }",
        "{ torus = { major = 0.6, minor = 0.2, level = 1 } }",
    ]);
    let [x, y, z] = [0; 3].map(|_| random.within(-1.5, 1.5));
    let [a, b] = [0; 2].map(|_| random.within(0.0, 90.0));
    let (normals, priority) = (random.pick(&["\"flat\"", "40"]), random.below(3));
    format!(
        "[[model]]\nshape = {shape}\nmaterial = \"m{model}\"\npriority = {priority}\nnormals = {normals}\n\
         rotate = [{a}, {b}, 0]\ntranslate = [{x}, {y}, {z}]\n"
    )
}

/// A permuted congruential generator (O'Neill 2014), reduced.
struct Random(u32);

impl Random {
    fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let word = ((self.0 >> ((self.0 >> 28) + 4)) ^ self.0).wrapping_mul(277_803_737);
        (word >> 22) ^ word
    }

    fn below(&mut self, end: u32) -> u32 {
        self.next() % end
    }

    fn within(&mut self, least: f32, most: f32) -> f32 {
        least + (most - least) * (self.next() >> 8) as f32 / (1 << 24) as f32
    }

    fn pick<'a>(&mut self, choices: &[&'a str]) -> &'a str {
        choices[self.below(choices.len() as u32) as usize]
    }
}
