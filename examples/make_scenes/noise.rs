//! Gradient noise over an integer hash: the same bits on every machine and run.

use glam::DVec3;

/// Bijective mix of 32 bits ("lowbias32", Chris Wellons, Prospecting for Hash Functions, 2018).
pub(crate) fn mix(mut x: u32) -> u32 {
    x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// Hash of a lattice point.
fn lattice([x, y, z]: [i64; 3], seed: u32) -> u32 {
    mix(x as u32 ^ mix(y as u32 ^ mix(z as u32 ^ mix(seed))))
}

/// A stream of uniform numbers in [0, 1).
#[derive(Debug, Clone)]
pub(crate) struct Random(u32);

impl Random {
    /// A stream of its own for each seed.
    pub(crate) fn new(seed: u32) -> Self {
        Self(mix(seed))
    }

    /// The next number in [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9);
        f64::from(mix(self.0)) / 4_294_967_296.0
    }

    /// The next number in [lo, hi).
    pub(crate) fn within(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * self.unit()
    }

    /// A point in the box.
    pub(crate) fn point(&mut self, lo: DVec3, hi: DVec3) -> DVec3 {
        DVec3::new(self.within(lo.x, hi.x), self.within(lo.y, hi.y), self.within(lo.z, hi.z))
    }
}

/// Gradient noise in about [−1, 1], one feature a unit, twice differentiable (Perlin, Improving Noise, 2002).
pub(crate) fn noise(p: DVec3, seed: u32) -> f64 {
    tiled_noise(p, [i64::MAX; 3], seed)
}

/// [`noise`] that repeats after `period` units along each axis.
pub(crate) fn tiled_noise(p: DVec3, period: [i64; 3], seed: u32) -> f64 {
    let cell = p.floor();
    let f = p - cell;
    let fade = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let cell = [cell.x as i64, cell.y as i64, cell.z as i64];
    let corner = |i: i64, j: i64, k: i64| {
        let wrapped = std::array::from_fn(|a| (cell[a] + [i, j, k][a]).rem_euclid(period[a]));
        let offset = f - DVec3::new(i as f64, j as f64, k as f64);
        gradient(lattice(wrapped, seed)).dot(offset)
    };
    let lerp = |a: f64, b: f64, t: f64| a + (b - a) * t;
    let edge = |j, k| lerp(corner(0, j, k), corner(1, j, k), fade.x);
    let face = |k| lerp(edge(0, k), edge(1, k), fade.y);
    1.5 * lerp(face(0), face(1), fade.z)
}

/// Squared distance to the nearest of one random point a unit cell (Worley, A Cellular Texture Basis Function,
/// 1996), as a soft minimum: paraboloid hollows whose ridges are the rounder, the smaller `sharpness` is.
pub(crate) fn hollows(p: DVec3, sharpness: f64, seed: u32) -> f64 {
    let home = p.floor();
    let mut sum = 0.0;
    for i in 0..27 {
        let cell = home + DVec3::new(f64::from(i % 3), f64::from(i / 3 % 3), f64::from(i / 9)) - 1.0;
        let hash = lattice([cell.x as i64, cell.y as i64, cell.z as i64], seed);
        let feature = cell + Random::new(hash).point(DVec3::splat(0.1), DVec3::splat(0.9));
        sum += (-sharpness * p.distance_squared(feature)).exp();
    }
    -sum.ln() / sharpness
}

/// A unit vector, uniform over the sphere.
fn gradient(hash: u32) -> DVec3 {
    let z = f64::from(hash >> 16) / 32_767.5 - 1.0;
    let (sin, cos) = (f64::from(hash & 0xffff) / 65_536.0 * std::f64::consts::TAU).sin_cos();
    let r = (1.0 - z * z).sqrt();
    DVec3::new(r * cos, r * sin, z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_bounded_and_moves() {
        let mut random = Random::new(7);
        let values: Vec<f64> =
            (0..4000).map(|_| noise(random.point(DVec3::splat(-9.0), DVec3::splat(9.0)), 1)).collect();
        let (lo, hi) = values.iter().fold((f64::MAX, f64::MIN), |(lo, hi), &v| (v.min(lo), v.max(hi)));
        assert!(lo > -1.5 && lo < -0.5, "{lo}");
        assert!(hi < 1.5 && hi > 0.5, "{hi}");
    }

    #[test]
    fn tiled_noise_repeats() {
        let p = DVec3::new(0.3, 1.7, -2.2);
        let shifted = p + DVec3::new(4.0, -8.0, 12.0);
        assert!((tiled_noise(p, [4; 3], 3) - tiled_noise(shifted, [4; 3], 3)).abs() < 1e-12);
    }
}
