# cmake -DROOT=<folder with Modules, Apps, Testing and Documentation> -P CheckWords.cmake
# Names that were given up for the field's terms must not come back. Fails with file, line and the word to use. Only names
# that mean nothing else are listed; Documentation/Changes.md tells what they became and may name them.
cmake_minimum_required(VERSION 3.18)

# A name as a regular expression, and what is said instead.
set(words
  "HandPort" "HapticPort"
  "CloudDetail" "LevelOfDetail"
  "[fF]airOrder" "ProgressiveOrder, progressiveOrder"
  "signOfLife|newestSign" "heartbeat"
  "sayGoodbye" "shutdown"
  "FalconServo" "FalconProtocol"
  "FalconNews|takeNews" "FalconUpdates, applyUpdates"
  "k?FalconLamp[A-Za-z]*|showLamps|usualLamps" "FalconLed, showLeds"
  "kSilence[A-Za-z]*" "kProgressDelay or kWatchdogTimeoutSeconds"
  "rehearse[sd]?" "prefetch"
  "mayRest|restsWhenIdle|restedTicks" "mayIdle, idlesWhenStill, idleTicks"
  "missedTicks|missed_ticks" "deadlineMisses, deadline_misses"
  "lateness" "jitter"
  "leavePart|withBeyond|wholeCloudNumber|ScenePart" "enterFallback, globalCloudNumber, LocalSceneBuilder"
  "fitShare" "fitWeight"
  "NearScene[A-Za-z]*" "LocalSceneProvider"
  "kProxyBallSpeaks" "kProxyBallContact"
  "Watcher|PartWatcher|WatchedPoints" "ProgressObserver, SubProgress, PointProgress"
  "PlacedPoints" "PointQuantizer"
  "Dealer" "PointBinner"
  "RecordPool" "PointRecordPool"
  "takeCarried|addCarried" "accumulate"
  "markDense" "occupancy bits and rank table"
  "SecondSums|batchSeconds_?" "secondMoments"
  "ResultMemory" "OutputAllocator"
  "assignInSets|canAssignInSets" "visitPoints"
  "forgiveNoise" "reclassifyMixedCells"
  "kernel::[A-Za-z_]+" "simd::")

list(LENGTH words length)
math(EXPR last "${length} - 2")
set(all "")
foreach (index RANGE 0 ${last} 2)
  list(GET words ${index} word)
  list(APPEND all "${word}")
endforeach ()
list(JOIN all "|" all)
set(before "(^|[^A-Za-z0-9_])")
set(after "($|[^A-Za-z0-9_])")

# Appends to problems each place of a file where a given-up name stands.
function (check_file file)
  file(READ "${file}" text)
  if (NOT text MATCHES "${before}(${all})${after}")
    return ()
  endif ()
  file(RELATIVE_PATH shown "${ROOT}" "${file}")
  string(REGEX REPLACE "[][;]" " " text "${text}") # no lists of CMake
  string(REPLACE "\n" ";" lines "${text}")
  set(number 0)
  foreach (line IN LISTS lines)
    math(EXPR number "${number} + 1")
    foreach (index RANGE 0 ${last} 2)
      list(GET words ${index} word)
      if (line MATCHES "${before}(${word})${after}")
        math(EXPR next "${index} + 1")
        list(GET words ${next} instead)
        list(APPEND problems "${shown}:${number}: ${CMAKE_MATCH_2}: say ${instead}")
      endif ()
    endforeach ()
  endforeach ()
  set(problems "${problems}" PARENT_SCOPE)
endfunction ()

set(problems "")
set(number_of_files 0)
foreach (folder IN ITEMS Modules Apps Testing Documentation)
  file(GLOB_RECURSE files "${ROOT}/${folder}/*.h" "${ROOT}/${folder}/*.cxx" "${ROOT}/${folder}/*.md"
    "${ROOT}/${folder}/*.sh" "${ROOT}/${folder}/CMakeLists.txt")
  list(FILTER files EXCLUDE REGEX "/Documentation/Changes\\.md$")
  foreach (file IN LISTS files)
    math(EXPR number_of_files "${number_of_files} + 1")
    check_file("${file}")
  endforeach ()
endforeach ()

if (problems)
  list(JOIN problems "\n  " text)
  message(FATAL_ERROR "Names that were given up for the field's terms:\n  ${text}")
endif ()
if (number_of_files EQUAL 0)
  message(FATAL_ERROR "${ROOT}: no source file below Modules, Apps, Testing and Documentation: is ROOT the folder of the sources?")
endif ()
message(STATUS "${number_of_files} files without a name that was given up")
