#!/usr/bin/env bash
# Runs the MISRA C 2012 addon of cppcheck on the headers, as a product includes them: `examples/c/misra.sh`. What is not one of the
# deviations that README lists is printed, and makes the exit status 1. cppcheck is a package of Debian.
set -euo pipefail
cd "$(dirname "$0")"
command -v cppcheck >/dev/null || apt-get install -y --no-install-recommends cppcheck

# Unused types, tags and macros (2.3, 2.4, 2.5); return where an input turns out to be bad (15.5); a number as its bytes (21.15).
deviations=(2.3 2.4 2.5 15.5 21.15)
suppressed=(--suppress=missingIncludeSystem)
for rule in "${deviations[@]}"; do
    suppressed+=("--suppress=misra-c2012-$rule")
done
unit=$(mktemp --suffix=.c)
trap 'rm -f "$unit"' EXIT
printf '#include "microimpact.h"\n#include "microimpact_link.h"\n#include "microimpact_instrument_link.h"\n' >"$unit"
cppcheck --quiet --std=c90 --addon=misra --enable=style --error-exitcode=1 -I include "${suppressed[@]}" "$unit"
echo "no deviation but from the rules ${deviations[*]}"
