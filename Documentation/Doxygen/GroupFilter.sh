#!/bin/sh
# GroupFilter.sh FILE: Doxygen reads a header through this, with all that it declares in the group that its module is. A
# group holds what stands in its own scope only, so it is closed and opened at the braces of the namespace.
module=${1##*/Modules/}
exec awk -v open="/** @addtogroup ${module%%/*} */ /** @{ */" -v close_="/** @} */" '
  NR == 1 { printf "%s ", open }
  /^namespace pointhaptics$/ { outside = depth; isNamespace = 1; printf "%s ", close_ }
  { before = depth; text = $0; depth += gsub(/{/, "", text) - gsub(/}/, "", text) }
  isNamespace && before == outside && depth > before { print $0 " " open; next }
  isNamespace && before > outside && depth == outside {
    isNamespace = 0; sub(/}/, close_ " } " open); print; next }
  { print }
  END { print close_ }' "$1"
