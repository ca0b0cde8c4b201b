# The program, without other tools:
#
#     docker build -t nbc .
#     docker run --rm -v "$PWD:/work" nbc run latch.nb
FROM rust:1.95-slim-bookworm AS build
WORKDIR /nbc
COPY . .
RUN cargo build --release --locked && strip target/release/nbc && .ci/licenses THIRD-PARTY.md

FROM debian:bookworm-slim
COPY --from=build /nbc/target/release/nbc /usr/local/bin/nbc
COPY --from=build /nbc/LICENSE-MIT /nbc/THIRD-PARTY.md /usr/share/doc/nbc/
WORKDIR /work
ENTRYPOINT ["nbc"]
