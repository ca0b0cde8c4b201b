//! `nbc devices` and `--device` in a program that was built without them.

use std::convert::Infallible;
use std::ffi::OsString;

use clap::Args;
use serde::{Serialize, Serializer};

use crate::cli::device::DeviceChoice;
use crate::cli::wording::NoDevices;
use crate::cli::{Context, Failure, Status};
use nbc_sim::{LaneBackend, Simulator};

/// List the OpenCL devices that can simulate (not in this build)
#[derive(Args)]
#[command(after_help = "Example:\n  nbc devices")]
pub struct NoDevicesArguments {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    rest: Vec<OsString>,
}

pub use NoDevicesArguments as DevicesArguments;

impl NoDevicesArguments {
    /// Says how to get it.
    ///
    /// # Errors
    /// Always.
    pub fn run(self, _context: &mut Context) -> Result<Status, Failure> {
        let _ = self.rest;
        Err(NoDevices.into())
    }
}

/// This processor.
#[derive(Clone)]
pub struct OnlyDevice(LaneBackend);

pub use OnlyDevice as OpenDevice;

/// The speed of a device that cannot be there.
pub struct NoFigures(Infallible);

pub use NoFigures as DeviceFigures;

impl OnlyDevice {
    /// This processor, if no other device is asked for.
    ///
    /// # Errors
    /// When one is.
    pub fn open(choice: DeviceChoice, processor: LaneBackend, _context: &Context) -> Result<Self, Failure> {
        match choice {
            DeviceChoice::Processor | DeviceChoice::Auto => Ok(Self(processor)),
            DeviceChoice::Device(_) => Err(NoDevices.into()),
        }
    }

    /// A simulator on it.
    pub fn simulator(&self) -> Simulator {
        Simulator::new(self.0.clone())
    }

    /// Nothing can fail.
    ///
    /// # Errors
    /// Never.
    pub fn check(&self) -> Result<(), Failure> {
        Ok(())
    }

    /// Nothing can fail.
    ///
    /// # Errors
    /// Never.
    pub fn end(&self, _context: &Context) -> Result<(), Failure> {
        Ok(())
    }

    /// There are none.
    pub fn figures(&self) -> Option<NoFigures> {
        None
    }
}

impl Serialize for NoFigures {
    fn serialize<S: Serializer>(&self, _serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {}
    }
}

impl NoFigures {
    /// Cannot be called.
    pub fn describe(&self) -> String {
        match self.0 {}
    }
}
