//! `--device`: where robots are simulated. Results do not depend on it. Without the feature `gpu` it is this processor.

use clap::Args;

#[derive(Args, Clone, Copy)]
pub struct DeviceArguments {
    /// Where to simulate: `cpu`, `gpu` for the first OpenCL device (`gpu:1` for another, as `nbc devices` counts them),
    /// or `auto` for a graphics card if there is one
    #[cfg(feature = "gpu")]
    #[arg(long, value_name = "DEVICE", default_value = "cpu", group = "place")]
    pub device: DeviceChoice,
}

#[cfg(feature = "gpu")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DeviceChoice {
    Processor,
    /// The OpenCL device with this number.
    Device(usize),
    /// A graphics card if there is one that can simulate, else this processor.
    Auto,
}

#[cfg(feature = "gpu")]
impl std::str::FromStr for DeviceChoice {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        let found = match word {
            "cpu" => Some(Self::Processor),
            "gpu" => Some(Self::Device(0)),
            "auto" => Some(Self::Auto),
            _ => word.strip_prefix("gpu:").and_then(|digits| digits.parse().ok()).map(Self::Device),
        };
        found.ok_or_else(|| "expected cpu, gpu, auto, or a device such as gpu:1".to_owned())
    }
}

#[cfg(all(test, feature = "gpu"))]
mod tests {
    use super::*;

    #[test]
    fn words() {
        let read = |word: &str| word.parse::<DeviceChoice>().ok();
        let found = ["cpu", "gpu", "gpu:2", "auto"].map(read).map(Option::unwrap);
        assert_eq!(
            found,
            [DeviceChoice::Processor, DeviceChoice::Device(0), DeviceChoice::Device(2), DeviceChoice::Auto]
        );
        assert_eq!(["", "GPU", "gpu:", "gpu:x", "cuda"].map(read), [None; 5]);
    }
}
