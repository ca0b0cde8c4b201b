//! `--device`: where robots are simulated. Results do not depend on it.

use std::str::FromStr;

use clap::Args;

/// The option, for commands that simulate.
#[derive(Args, Clone, Copy)]
pub struct DeviceArguments {
    /// Where to simulate: `cpu`, `gpu` for the first OpenCL device (`gpu:1` for another, as `nbc devices` counts them),
    /// or `auto` for a graphics card if there is one
    #[cfg_attr(not(feature = "gpu"), arg(hide = true))]
    #[arg(long, value_name = "DEVICE", default_value = "cpu", group = "place")]
    device: DeviceChoice,
}

/// A choice of a device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DeviceChoice {
    /// This processor.
    #[default]
    Processor,
    /// The OpenCL device with this number.
    Device(usize),
    /// A graphics card if there is one that can simulate, else this processor.
    Auto,
}

impl DeviceArguments {
    /// The choice of the user, by default the processor.
    pub fn choice(self) -> DeviceChoice {
        self.device
    }
}

impl FromStr for DeviceChoice {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        let number = |digits: &str| digits.parse().ok().map(Self::Device);
        let found = match word {
            "cpu" => Some(Self::Processor),
            "gpu" => Some(Self::Device(0)),
            "auto" => Some(Self::Auto),
            _ => word.strip_prefix("gpu:").and_then(number),
        };
        found.ok_or_else(|| "expected cpu, gpu, auto, or a device such as gpu:1".to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words() {
        let read = |word: &str| word.parse::<DeviceChoice>().ok();
        assert_eq!(read("cpu"), Some(DeviceChoice::Processor));
        assert_eq!(read("gpu"), Some(DeviceChoice::Device(0)));
        assert_eq!(read("gpu:2"), Some(DeviceChoice::Device(2)));
        assert_eq!(read("auto"), Some(DeviceChoice::Auto));
        assert_eq!(["", "GPU", "gpu:", "gpu:x", "cuda"].map(read), [None; 5]);
    }
}
