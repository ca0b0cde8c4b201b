//! Keys of NATS, made with openssl.

use std::process::Command;

use data_encoding::BASE32_NOPAD;

use crate::support::*;

/// Whose key it is: the byte before the key, which its first letter shows.
#[derive(Clone, Copy)]
pub enum Owner {
    Account = 0,
    Operator = 14 << 3,
    User = 20 << 3,
}

/// An Ed25519 key in a file.
pub struct Key {
    owner: Owner,
    file: PathBuf,
}

impl Key {
    pub fn new(folder: &Path, owner: Owner, name: &str) -> Self {
        let key = Self { owner, file: folder.join(format!("{name}.pem")) };
        openssl(&["genpkey", "-algorithm", "ed25519", "-out", key.path()]);
        key
    }

    fn path(&self) -> &str {
        self.file.to_str().unwrap()
    }

    /// The last 32 bytes of a key in binary are the key itself.
    fn bytes(&self, more: &[&str]) -> Vec<u8> {
        let made = openssl(&[&["pkey", "-in", self.path(), "-outform", "DER"], more].concat());
        made[made.len() - 32..].to_vec()
    }

    pub fn public(&self) -> String {
        encoded([&[self.owner as u8], &self.bytes(&["-pubout"])[..]].concat())
    }

    pub fn seed(&self) -> String {
        let owner = self.owner as u8;
        let prefix = [18 << 3 | owner >> 5, (owner & 31) << 3];
        encoded([&prefix, &self.bytes(&[])[..]].concat())
    }

    pub fn sign(&self, text: &str) -> Vec<u8> {
        let message = self.file.with_extension("txt");
        fs::write(&message, text).unwrap();
        openssl(&["pkeyutl", "-sign", "-rawin", "-inkey", self.path(), "-in", message.to_str().unwrap()])
    }
}

fn openssl(arguments: &[&str]) -> Vec<u8> {
    let ran = Command::new("openssl").args(arguments).output_in_time();
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    ran.stdout
}

/// A key as text: its bytes and their CRC-16 (XMODEM) in base 32.
fn encoded(mut bytes: Vec<u8>) -> String {
    let bit = |crc: u16, _| if crc & 0x8000 == 0 { crc << 1 } else { crc << 1 ^ 0x1021 };
    let sum = bytes.iter().fold(0, |crc: u16, &byte| (0..8).fold(crc ^ u16::from(byte) << 8, bit));
    bytes.extend(sum.to_le_bytes());
    BASE32_NOPAD.encode(&bytes)
}
