//! Where the time from a scene's file to its picture goes, and how many pictures an adapter's start is worth.

use serde::{Deserialize, Serialize};

/// The parts of the way from file to picture, in milliseconds; what a device does not do takes none.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Phases {
    /// Reading, checking and flattening the scene.
    pub load: f64,
    /// Building the tree; on the CPU also collapsing it into the wide one.
    pub bvh: f64,
    /// Starting threads, or opening the adapter.
    pub open: f64,
    /// Scene to device memory.
    pub upload: f64,
    /// Assembling the shader and creating its pipeline, first dispatch included, with nothing kept by us.
    pub compile_cold: f64,
    /// The same with what the first time left in the pipeline cache. It stands for the cold one, not beside it.
    pub compile_warm: f64,
    /// Tracing alone: by timestamps of the adapter where it has them.
    pub trace: f64,
    /// What the host waits beside it, submitting and hearing of the end; none without timestamps.
    pub wait: f64,
    /// Film to host memory.
    pub readback: f64,
    /// Picture to PNG.
    pub encode: f64,
}

impl Phases {
    /// Milliseconds before the first ray of a first start.
    #[must_use]
    pub fn start(&self) -> f64 {
        self.load + self.bvh + self.open + self.upload + self.compile_cold
    }

    /// Milliseconds of each picture.
    #[must_use]
    pub fn frame(&self) -> f64 {
        self.trace + self.wait + self.readback + self.encode
    }

    /// Milliseconds from file to picture.
    #[must_use]
    pub fn picture(&self) -> f64 {
        self.start() + self.frame()
    }
}

/// Of how many pictures of a scene, its start included, an adapter has made all before the CPU has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BreakEven {
    /// Of so many, and of any more.
    From(u64),
    /// Of no more than so many.
    UpTo(u64),
    /// Of none.
    Never,
}

impl BreakEven {
    /// Of the phases on the CPU and on the adapter.
    #[must_use]
    pub fn of(cpu: &Phases, adapter: &Phases) -> Self {
        let ahead_at_start = cpu.start() - adapter.start();
        let won_by_frame = cpu.frame() - adapter.frame();
        if won_by_frame > 0.0 {
            return Self::From((-ahead_at_start / won_by_frame).max(0.0).floor() as u64 + 1);
        }
        if won_by_frame == 0.0 && ahead_at_start > 0.0 {
            return Self::From(1);
        }
        match (ahead_at_start / -won_by_frame).ceil() as u64 {
            0 | 1 => Self::Never,
            frames => Self::UpTo(frames - 1),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn phases(start: f64, frame: f64) -> Phases {
        Phases { load: start, trace: frame, ..Phases::default() }
    }

    #[test]
    fn phases_add_up_to_the_picture_and_a_warm_start_is_not_beside_the_cold_one() {
        let all = Phases {
            load: 1.0,
            bvh: 2.0,
            open: 4.0,
            upload: 8.0,
            compile_cold: 16.0,
            compile_warm: 1024.0,
            trace: 32.0,
            wait: 64.0,
            readback: 128.0,
            encode: 256.0,
        };
        assert_eq!((all.start(), all.frame(), all.picture()), (31.0, 480.0, 511.0));
    }

    #[test]
    fn a_start_is_worth_as_many_pictures_as_win_it_back() {
        let cpu = phases(10.0, 100.0);
        for (start, frame, expected) in [
            // 1000 ms later, 50 a picture: even at 20, ahead from 21 on.
            (1010.0, 50.0, BreakEven::From(21)),
            (1011.0, 50.0, BreakEven::From(21)),
            (5.0, 50.0, BreakEven::From(1)),
            (5.0, 100.0, BreakEven::From(1)),
            (10.0, 100.0, BreakEven::Never),
            (20.0, 200.0, BreakEven::Never),
            // 5 ms earlier, 2 lost a picture: ahead of two, no more of three.
            (5.0, 102.0, BreakEven::UpTo(2)),
            (5.0, 105.0, BreakEven::Never),
        ] {
            assert_eq!(BreakEven::of(&cpu, &phases(start, frame)), expected, "{start} {frame}");
        }
    }
}
