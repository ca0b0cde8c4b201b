//! Standard output as a pipe whose reader may close it at any moment.

use std::io::{self, BufWriter, Stdout, Write};

/// Buffered standard output. After the reader closes the pipe, further output is dropped without an error: `nbc … |
/// head` must not change the exit status.
pub(super) struct Output<W: Write = Stdout> {
    /// `None` after the pipe was closed.
    open: Option<BufWriter<W>>,
}

impl<W: Write> Output<W> {
    pub(super) fn new(out: W) -> Self {
        Self { open: Some(BufWriter::new(out)) }
    }

    fn with<T>(&mut self, swallowed: T, work: impl FnOnce(&mut BufWriter<W>) -> io::Result<T>) -> io::Result<T> {
        let Some(out) = &mut self.open else { return Ok(swallowed) };
        match work(out) {
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => {
                // The rest of the buffer is dropped with it, and not written again.
                let _ = self.open.take().map(BufWriter::into_parts);
                Ok(swallowed)
            }
            done => done,
        }
    }
}

impl<W: Write> Write for Output<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.with(bytes.len(), |out| out.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.with((), BufWriter::flush)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Takes `room` bytes before it fails.
    struct Pipe {
        room: usize,
        error: io::ErrorKind,
    }

    impl Write for Pipe {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.room = self.room.checked_sub(bytes.len()).ok_or(self.error)?;
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    fn written(error: io::ErrorKind) -> io::Result<()> {
        let mut out = Output::new(Pipe { room: 10, error });
        for _ in 0..3 {
            out.write_all(b"eight by")?;
            out.flush()?;
        }
        out.write_all(&[b'x'; 100_000])
    }

    #[test]
    fn a_closed_pipe_is_ignored_and_other_errors_are_not() {
        assert!(written(io::ErrorKind::BrokenPipe).is_ok());
        assert_eq!(written(io::ErrorKind::StorageFull).unwrap_err().kind(), io::ErrorKind::StorageFull);
    }
}
