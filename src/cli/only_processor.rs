//! What simulates the robots of a command in a program without devices.

use crate::cli::options::device::DeviceArguments;
use crate::cli::{Context, Failure};
use nbc_sim::{LaneBackend, Simulator};

/// Has the functions of the device that a program with the feature `gpu` opens.
#[derive(Clone)]
pub struct OnlyProcessor(LaneBackend);

impl OnlyProcessor {
    pub fn open(_: DeviceArguments, processor: LaneBackend, _: &Context) -> Result<Self, Failure> {
        Ok(Self(processor))
    }

    pub fn simulator(&self) -> Simulator {
        Simulator::new(self.0.clone())
    }

    pub fn is_device(&self) -> bool {
        false
    }

    pub fn check(&self) -> Result<(), Failure> {
        Ok(())
    }

    pub fn end(&self, _: &Context) -> Result<(), Failure> {
        Ok(())
    }
}
