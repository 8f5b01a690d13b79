#!/usr/bin/env bash
# Builds the static library for a named core, and installs it with its headers, a CMake package and a pkg-config file:
#     examples/c/build.sh CORE [--size] [--prefix FOLDER]
# The folder is examples/c/target/package/CORE unless another is named. --size builds for size instead of speed. RUSTFLAGS is passed on.
set -euo pipefail

cores="cortex-m0 cortex-m0plus cortex-m3 cortex-m4 cortex-m4f cortex-m7 cortex-m23 cortex-m33 rv32imc rv32imac host"
usage() {
    echo "usage: build.sh CORE [--size] [--prefix FOLDER], where CORE is one of $cores" >&2
    exit 2
}

test $# -ge 1 || usage
core=$1
shift
case $core in
cortex-m0 | cortex-m0plus) triple=thumbv6m-none-eabi ;;
cortex-m3) triple=thumbv7m-none-eabi ;;
cortex-m4) triple=thumbv7em-none-eabi ;;
cortex-m4f | cortex-m7) triple=thumbv7em-none-eabihf ;;
cortex-m23) triple=thumbv8m.base-none-eabi ;;
cortex-m33) triple=thumbv8m.main-none-eabihf ;;
rv32imc) triple=riscv32imc-unknown-none-elf ;;
rv32imac) triple=riscv32imac-unknown-none-elf ;;
host) triple=$(rustc -vV | sed -n 's/^host: //p') ;;
*) usage ;;
esac

source=$(cd "$(dirname "$0")" && pwd)
prefix=$source/target/package/$core
level=3
while test $# -gt 0; do
    case $1 in
    --size) level='"s"' ;;
    --prefix)
        test $# -ge 2 || usage
        prefix=$2
        shift
        ;;
    *) usage ;;
    esac
    shift
done

if ! test -d "$(rustc --print target-libdir --target "$triple")"; then
    rustup target add "$triple"
fi
cargo build --locked --release --manifest-path "$source/Cargo.toml" --target "$triple" --target-dir "$source/target" \
    --config "profile.release.opt-level=$level"

version=$(sed -n 's/^version = "\(.*\)"/\1/p' "$source/../../Cargo.toml" | head -1)
install -d "$prefix/lib/cmake/microimpact" "$prefix/lib/pkgconfig" "$prefix/include"
install -m 644 "$source/target/$triple/release/libmicroimpact_c.a" "$prefix/lib"
install -m 644 "$source"/include/*.h "$prefix/include"
install -m 644 "$source/package/microimpactConfig.cmake" "$prefix/lib/cmake/microimpact"
sed "s|@VERSION@|$version|" "$source/package/microimpactConfigVersion.cmake" >"$prefix/lib/cmake/microimpact/microimpactConfigVersion.cmake"
sed "s|@VERSION@|$version|" "$source/package/microimpact.pc" >"$prefix/lib/pkgconfig/microimpact.pc"
echo "$prefix"
