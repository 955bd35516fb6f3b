# awk -f CommentOpenings.awk FILE...
# Prints "file:line: comment" for each comment of C++, Python, CMake or shell that opens with "Of", "The same" or "What": the
# reader then has to guess which thing is meant. Only the first line of a comment counts.
function check(text) {
  sub(/^@brief +/, "", text)
  if (text ~ /^(Of|What|The same)([^A-Za-z]|$)/) {
    printf "%s:%d: %s\n", FILENAME, FNR, text
  }
}

FNR == 1 {
  isLine = 0
  isBlock = 0
  isCpp = FILENAME ~ /\.(h|cxx)$/
}

# A block comment may have its text on the line after its beginning.
isCpp && isBlock {
  isBlock = 0
  if (match($0, /^ *\* */)) {
    check(substr($0, RLENGTH + 1))
  }
  next
}

isCpp && match($0, /^ *\/\*[*!]?<? */) {
  isLine = 0
  isBlock = $0 ~ /^ *\/\*[*!]? *$/
  check(substr($0, RLENGTH + 1))
  next
}

isCpp && match($0, /^ *\/\/[\/!]?<? */) {
  if (!isLine && $0 !~ /^ *\/\/[\/!]?</) {
    check(substr($0, RLENGTH + 1))
  }
  isLine = $0 !~ /^ *\/\/\/ ?@(file|{|})$/
  next
}

# A comment behind code.
isCpp && match($0, /[^ ] *(\/\/[\/!]?<?|\/\*[*!]?<) +/) {
  isLine = 0
  check(substr($0, RSTART + RLENGTH))
  next
}

!isCpp && match($0, /^ *(# |r?""")/) {
  if (!isLine || $0 ~ /"""/) {
    check(substr($0, RLENGTH + 1))
  }
  isLine = $0 ~ /^ *#/
  next
}

{ isLine = 0 }
