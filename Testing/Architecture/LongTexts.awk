# awk -v functionLines=60 -v fileLines=600 -f LongTexts.awk FILE...
# Prints the C++ files with more lines than that, "file has N lines", and the functions whose bodies have more,
# "file:line: name has N lines". Reads the project's format: a function's braces have lines of their own, in the first column
# or, as a member of a class, in the third; the last line of its head stands right above. What is no function, a namespace,
# class or list, says so in its head or has no parentheses there.
function endFile() {
  if (fileName != "" && fileLength > fileLines) {
    printf "%s has %d lines\n", fileName, fileLength
  }
}

FNR == 1 {
  endFile()
  head = ""
  start = 0
}

{
  fileName = FILENAME
  fileLength = FNR
}

/^(  )?\{$/ && start == 0 && head ~ /\(/ && head !~ /^ *(template *<.*> *)?(namespace|class|struct|union|enum)( |$)/ {
  start = FNR
  indent = index($0, "{")
  name = head
}

/^(  )?\}/ && start > 0 && index($0, "}") == indent {
  if (FNR - start - 1 > functionLines) {
    sub(/\(.*/, "", name)
    sub(/.*[ *&]/, "", name)
    printf "%s:%d: %s has %d lines\n", FILENAME, start, name, FNR - start - 1
  }
  start = 0
}

# A head goes on until its brace, and begins after an empty line, a comment or the end of something else.
/^ *$/ || /[;{}]$/ || /^ *(\/\/|#)/ || /^ *(public|private|protected):$/ {
  head = ""
  next
}

{ head = head " " $0 }

END { endFile() }
