#!/bin/sh
# check.sh NM KNOWN_STATICS ARCHIVE...: what the libraries' symbols say, one line a fault.
# Sections: .data.rel.ro is closed before main() runs; .data.rel.local.DW.ref is the compiler's own.
nm=$1 known=$2
shift 2
"$nm" --demangle --format=sysv "$@" 2>/dev/null | awk -F'|' -v known="$known" '
  BEGIN {
    while ((getline line < known) > 0) {
      split(line, part, " : ")
      if (line !~ /^#/ && line != "") reason[part[1]] = part[2]
    }
  }
  function fault(text) { if (!told[text]++) print text; faults++ }
  NF < 6 { next }
  {
    name = $1; class = $(NF - 4); section = $NF
    sub(/ +$/, "", name); gsub(/ /, "", class); gsub(/ /, "", section)
    defined++
  }
  class == "u" { fault("unique, so that dlclose leaves a plug-in where it is: " name) }
  # length() is the one function that is not forced inline, and the same for every host; what returns a GLM type may be
  # a function of the C++ library, whose body no macro changes.
  name ~ /^([a-z0-9_:<>, ]* )?glm::/ && name !~ /::length\(\)/ && name !~ /^glm::.*>& std::/ && section ~ /^\.text/ && name !~ /blush::/ {
    fault("a host with other GLM_FORCE_ macros could take its place: " name)
  }
  section ~ /^\.(bss|data|tbss|tdata)/ && section !~ /^\.data\.rel\.(ro|local\.DW)/ {
    sub(/^guard variable for /, "", name)
    if (!reason[name]) fault("data that can be written, and no reason for it in " known ": " name)
  }
  END {
    if (defined < 1000) fault("the archives have hardly any symbols: " defined + 0)
    exit faults > 0
  }'
