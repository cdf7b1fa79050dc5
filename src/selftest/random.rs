//! Random numbers that are the same in every run, on every machine.

use glam::DVec3;

/// PCG (O'Neill 2014, "PCG: a family of simple fast space-efficient statistically good algorithms"), 64 bits of state.
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    /// A sequence of its own for each name.
    #[must_use]
    pub fn new(name: &str) -> Self {
        // FNV-1a.
        let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        let mut random = Self(name.bytes().fold(0xcbf2_9ce4_8422_2325, step));
        random.word();
        random
    }

    /// Any 32 bits.
    pub fn word(&mut self) -> u32 {
        let state = self.0;
        self.0 = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let xorshifted = (((state >> 18) ^ state) >> 27) as u32;
        xorshifted.rotate_right((state >> 59) as u32)
    }

    /// A whole number below `end`, which is not 0.
    pub fn below(&mut self, end: u32) -> u32 {
        ((u64::from(self.word()) * u64::from(end)) >> 32) as u32
    }

    /// In [0, 1).
    pub fn fraction(&mut self) -> f64 {
        f64::from(self.word()) / 4_294_967_296.0
    }

    /// In [least, most).
    pub fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.fraction()
    }

    /// ±10^e with e evenly in [least, most): every magnitude is met, with either sign.
    pub fn log_uniform(&mut self, least: f64, most: f64) -> f64 {
        let magnitude = 10f64.powf(self.between(least, most));
        if self.word() & 1 == 0 { magnitude } else { -magnitude }
    }

    /// A unit vector, all directions alike (Marsaglia 1972: by the cylinder that holds the sphere).
    pub fn direction(&mut self) -> DVec3 {
        let z = self.between(-1.0, 1.0);
        let (sin, cos) = self.between(0.0, std::f64::consts::TAU).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        DVec3::new(radius * cos, radius * sin, z)
    }

    /// Barycentric weights of a triangle's second and third corner, all points alike.
    pub fn barycentrics(&mut self) -> [f64; 2] {
        let [a, b] = [self.fraction(), self.fraction()];
        if a + b > 1.0 { [1.0 - a, 1.0 - b] } else { [a, b] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_lie_in_their_ranges_and_fill_them() {
        let mut random = Random::new("ranges");
        let mut seen = [false; 7];
        for _ in 0..1000 {
            seen[random.below(7) as usize] = true;
            assert!((-2.0..3.0).contains(&random.between(-2.0, 3.0)));
            assert!((1e-8..1e8).contains(&random.log_uniform(-8.0, 8.0).abs()));
            assert!((random.direction().length() - 1.0).abs() < 1e-12);
            let [b1, b2] = random.barycentrics();
            assert!(b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0);
        }
        assert_eq!(seen, [true; 7]);
    }

    #[test]
    fn every_name_has_a_sequence_of_its_own() {
        assert_eq!(Random::new("a").word(), Random::new("a").word());
        assert_ne!(Random::new("a").word(), Random::new("b").word());
    }
}
