#!/bin/sh
# measure_apart.sh NM ROOT ARCHIVE...: whether studies stay out of what engines link, one line a fault. ROOT has rooms
# whose sources are read, the archives are the libraries'.
nm=$1 root=$2
shift 2
faults=$(mktemp) || exit 2
"$nm" --demangle --format=posix "$@" 2>/dev/null |
  grep -oE 'blush::[^ (]*(Study|Studied|studies|Variant\b|Portrait|AppearanceProbe|AccuracyReport)[^ (]*' | sort -u |
  sed 's/^/an engine would link what measures: /' >"$faults"
grep -rnE '#include "(runtime/measure|tools|tests)/' "$root/rig" "$root/runtime" "$root/shaders" |
  grep -vE "^$root/runtime/measure/[^:]*:[0-9]+:#include \"runtime/" | sed 's/^/enters a room that it may not: /' >>"$faults"
cat "$faults"
if [ -s "$faults" ]; then rm "$faults"; exit 1; fi
rm "$faults"
