//! Options that several commands share.

pub(super) mod device;
pub(super) mod files;
pub(super) mod images;
pub(super) mod making;
pub(super) mod mapping;
pub(super) mod new_path;
pub(super) mod number;
pub(super) mod queue;
pub(super) mod robots;
pub(super) mod timings;
