//! The state that all pages of a server share: what it serves, its address, and the access rules.

use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, UdpSocket};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use tungstenite::http::{HeaderMap, header};

use crate::page::Page;
use crate::threads::Threads;
use nbc_play::{Class, PlaySite};
use nbc_session::store::FolderWorld;

/// The default and the largest number of pages for which there is room.
pub(super) const PAGES: usize = 16;
pub(super) const MOST_PAGES: usize = 64;
pub(super) const SOCKETS_OF_PAGE: usize = 2;

pub(super) struct Served {
    pub(super) site: Arc<PlaySite>,
    pub(super) threads: Arc<Threads>,
    pub(super) world: FolderWorld,
    pub(super) token: String,
    pub(super) host: String,
    pub(super) port: u16,
    pub(super) page: Page,
    pub(super) taught: Option<Taught>,
    pub(super) most_sockets: usize,
    pub(super) sockets: AtomicUsize,
    /// The bytes of all messages that wait to be handled.
    pub(super) waiting: AtomicUsize,
    pub(super) begun: Instant,
}

pub(super) struct Taught {
    pub(super) class: Arc<Class>,
    pub(super) token: String,
}

impl Served {
    pub(super) fn new(world: FolderWorld, site: PlaySite, threads: Arc<Threads>, token: String) -> Self {
        Self {
            site: Arc::new(site),
            threads,
            world,
            token,
            host: String::new(),
            port: 0,
            page: Page::default(),
            taught: None,
            most_sockets: PAGES * SOCKETS_OF_PAGE,
            sockets: AtomicUsize::new(0),
            waiting: AtomicUsize::new(0),
            begun: Instant::now(),
        }
    }

    pub(super) fn now(&self) -> Duration {
        self.begun.elapsed()
    }

    pub(super) fn address(&self) -> String {
        self.local_address(&self.token)
    }

    pub(super) fn address_of_teacher(&self) -> Option<String> {
        self.taught.as_ref().map(|taught| self.local_address(&taught.token))
    }

    fn local_address(&self, token: &str) -> String {
        match self.everywhere() {
            Some(IpAddr::V4(_)) => self.address_at(&Ipv4Addr::LOCALHOST.to_string(), token),
            Some(IpAddr::V6(_)) => self.address_at(&Ipv6Addr::LOCALHOST.to_string(), token),
            None => self.address_at(&self.host, token),
        }
    }

    /// The address for other computers, if the server listens at all addresses of this one and it has one in a network.
    pub(super) fn address_elsewhere(&self) -> Option<String> {
        // Nothing is sent: the system only chooses the address that it would send from. The target is one of those that
        // are kept for documents.
        let (any, target) = match self.everywhere()? {
            IpAddr::V4(_) => ("0.0.0.0:0", "192.0.2.1:9"),
            IpAddr::V6(_) => ("[::]:0", "[2001:db8::1]:9"),
        };
        let socket = UdpSocket::bind(any).ok()?;
        socket.connect(target).ok()?;
        let own = socket.local_addr().ok()?.ip();
        (!own.is_loopback()).then(|| self.address_at(&own.to_string(), &self.token))
    }

    fn address_at(&self, host: &str, token: &str) -> String {
        let host = if host.contains(':') { format!("[{host}]") } else { host.to_owned() };
        format!("http://{host}:{}/{token}/", self.port)
    }

    fn everywhere(&self) -> Option<IpAddr> {
        self.host.parse().ok().filter(IpAddr::is_unspecified)
    }

    pub(super) fn is_full(&self) -> bool {
        self.sockets.load(Ordering::Relaxed) + SOCKETS_OF_PAGE > self.most_sockets
    }

    pub(super) fn with_place(&self, serve: impl FnOnce()) -> bool {
        let has_place = self.sockets.fetch_add(1, Ordering::Relaxed) < self.most_sockets;
        if has_place {
            serve();
        }
        self.sockets.fetch_sub(1, Ordering::Relaxed);
        has_place
    }

    pub(super) fn knows(&self, token: &str) -> bool {
        is_same(token, &self.token)
    }

    pub(super) fn taught(&self, token: &str) -> Option<&Class> {
        self.taught.as_ref().filter(|taught| is_same(token, &taught.token)).map(|taught| &*taught.class)
    }

    /// Whether a request comes from this server's own page: its only `Host` is an address of this server (a name of
    /// another site that points to this computer is not), and its only `Origin`, if any, is the same.
    pub(super) fn trusts(&self, headers: &HeaderMap) -> bool {
        let all = |name| headers.get_all(name).iter().map(|value| value.to_str().unwrap_or("")).collect::<Vec<_>>();
        // Of several values, a program before this one may have looked at another.
        let (hosts, origins) = (all(header::HOST), all(header::ORIGIN));
        let [host] = hosts[..] else { return false };
        let is_same = |origin: &&str| origin.strip_prefix("http://") == Some(host);
        self.is_own(host) && origins.len() <= 1 && origins.iter().all(is_same)
    }

    pub(super) fn is_own(&self, host: &str) -> bool {
        let port = format!(":{}", self.port);
        let Some(name) = host.strip_suffix(&port) else { return false };
        let address = name.trim_start_matches('[').trim_end_matches(']').parse::<IpAddr>();
        let everywhere = self.everywhere().is_some();
        name == "localhost"
            || name == self.host
            || address.is_ok_and(|address| everywhere || address.is_loopback() || address.to_string() == self.host)
    }
}

/// Takes the same time for any wrong token.
fn is_same(token: &str, secret: &str) -> bool {
    let differ = token.bytes().zip(secret.bytes()).fold(0, |differ, (a, b)| differ | (a ^ b));
    token.len() == secret.len() && differ == 0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::disk_folder::DiskFolder;
    use nbc_session::CompileOptions;

    fn served(host: &str) -> Served {
        let folder = tempfile::tempdir().unwrap();
        let world = FolderWorld::new(folder.path()).unwrap();
        let threads = Arc::new(Threads::new(&[]));
        let site = PlaySite {
            folder: Arc::new(DiskFolder::new(world.clone())),
            file: None,
            making: CompileOptions::default(),
            live_pages: false,
            public_page: None,
            class: None,
            shell: threads.clone(),
        };
        let served = Served::new(world, site, threads, "secret".to_owned());
        Served { host: host.to_owned(), port: 80, ..served }
    }

    fn headers(host: &str, origin: Option<&str>) -> HeaderMap {
        let mut headers = HeaderMap::new();
        headers.insert(header::HOST, host.parse().unwrap());
        origin.into_iter().for_each(|origin| _ = headers.insert(header::ORIGIN, origin.parse().unwrap()));
        headers
    }

    #[test]
    fn only_the_own_page_is_trusted() {
        let local = served("127.0.0.1");
        for host in ["127.0.0.1:80", "localhost:80", "[::1]:80"] {
            assert!(local.trusts(&headers(host, None)));
            assert!(local.trusts(&headers(host, Some(&format!("http://{host}")))));
            assert!(!local.trusts(&headers(host, Some("http://evil.example"))));
        }
        for host in ["evil.example:80", "127.0.0.1:81", "192.168.0.7:80", "localhost", ""] {
            assert!(!local.trusts(&headers(host, None)), "{host}");
        }
        assert!(!local.trusts(&HeaderMap::new()));
        let own = "127.0.0.1:80";
        for (name, values) in [(header::HOST, [own, "evil.example:80"]), (header::HOST, ["evil.example:80", own])] {
            let mut twice = headers(own, None);
            twice.remove(&name);
            values.into_iter().for_each(|value| _ = twice.append(&name, value.parse().unwrap()));
            assert!(!local.trusts(&twice), "{values:?}");
        }
        let mut twice = headers(own, Some("http://127.0.0.1:80"));
        twice.append(header::ORIGIN, "http://127.0.0.1:80".parse().unwrap());
        assert!(!local.trusts(&twice));
        let open = served("0.0.0.0");
        assert!(open.trusts(&headers("192.168.0.7:80", Some("http://192.168.0.7:80"))));
        assert!(!open.trusts(&headers("evil.example:80", None)));
    }

    #[test]
    fn the_token_must_be_right() {
        let served = served("::1");
        assert_eq!(served.address(), "http://[::1]:80/secret/");
        assert_eq!(served.address_elsewhere(), None);
        assert!(served.knows("secret"));
        assert!(!served.knows("secreT") && !served.knows("secret1") && !served.knows(""));
    }

    #[test]
    fn an_address_that_a_browser_accepts_is_told() {
        for (host, own) in [("0.0.0.0", "127.0.0.1"), ("::", "[::1]"), ("192.168.0.7", "192.168.0.7")] {
            let served = served(host);
            assert_eq!(served.address(), format!("http://{own}:80/secret/"));
            let elsewhere = served.address_elsewhere().unwrap_or_default();
            assert!(!elsewhere.contains("0.0.0.0") && !elsewhere.contains("[::]"), "{elsewhere}");
        }
    }
}
