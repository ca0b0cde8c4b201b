//! The OpenCL devices of this machine.

use opencl3::device::{
    CL_DEVICE_TYPE_ALL, CL_DEVICE_TYPE_CPU, CL_DEVICE_TYPE_GPU, CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT, Device,
};
use opencl3::error_codes::ClError;
use opencl3::platform::{Platform, get_platforms};
use opencl3::types::cl_device_id;

use crate::backend::opencl::error::DeviceError;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum DeviceKind {
    Graphics,
    Other,
    Processor,
}

impl DeviceKind {
    pub fn word(self) -> &'static str {
        match self {
            Self::Graphics => "gpu",
            Self::Other => "accelerator",
            Self::Processor => "cpu",
        }
    }
}

#[derive(Clone, Debug)]
pub struct OpenClDevice {
    /// Its number, from 0: graphics cards first, processors last.
    pub number: usize,
    pub name: String,
    pub platform: String,
    pub driver: String,
    pub kind: DeviceKind,
    pub global_bytes: u64,
    /// The size of the largest buffer, in bytes.
    pub buffer_bytes: u64,
    pub local_bytes: usize,
    pub multiprocessors: usize,
    pub group_size: usize,
    pub has_doubles: bool,
    /// Whether it rounds roots and quotients of single precision correctly.
    pub rounds_single: bool,
    device: Device,
}

impl OpenClDevice {
    pub fn all() -> Result<Vec<Self>, DeviceError> {
        let platforms = get_platforms().map_err(|_| DeviceError::NoDriver)?;
        if platforms.is_empty() {
            return Err(DeviceError::NoDriver);
        }
        let mut devices: Vec<Self> = platforms.iter().flat_map(of_platform).collect();
        devices.sort_by_key(|device| device.kind);
        for (number, device) in devices.iter_mut().enumerate() {
            device.number = number;
        }
        Ok(devices)
    }

    pub(super) fn id(&self) -> cl_device_id {
        self.device.id()
    }
}

fn of_platform(platform: &Platform) -> Vec<OpenClDevice> {
    let name = platform.name().unwrap_or_default();
    // A platform without devices says so by an error.
    let found = platform.get_devices(CL_DEVICE_TYPE_ALL).unwrap_or_default();
    found.into_iter().filter_map(|id| describe(Device::new(id), &name).ok()).collect()
}

fn describe(device: Device, platform: &str) -> Result<OpenClDevice, ClError> {
    let kind = match device.dev_type()? {
        kind if kind & CL_DEVICE_TYPE_GPU != 0 => DeviceKind::Graphics,
        kind if kind & CL_DEVICE_TYPE_CPU != 0 => DeviceKind::Processor,
        _ => DeviceKind::Other,
    };
    Ok(OpenClDevice {
        number: 0,
        name: device.name()?.trim().to_owned(),
        platform: platform.trim().to_owned(),
        driver: device.driver_version()?.trim().to_owned(),
        kind,
        global_bytes: device.global_mem_size()?,
        buffer_bytes: device.max_mem_alloc_size()?,
        local_bytes: device.local_mem_size()? as usize,
        multiprocessors: device.max_compute_units()? as usize,
        group_size: device.max_work_group_size()?,
        has_doubles: device.double_fp_config().unwrap_or(0) != 0,
        rounds_single: device.single_fp_config()? & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT != 0,
        device,
    })
}
