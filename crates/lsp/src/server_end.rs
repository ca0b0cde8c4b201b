//! How serving a client ended.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ServerEnd {
    /// The client asked the server to shut down, or vanished.
    Orderly,
    /// The client ended the server without a request to shut down, which is a failure by the protocol.
    Abandoned,
}
