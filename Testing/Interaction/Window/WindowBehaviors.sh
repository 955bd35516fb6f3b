# shellcheck shell=bash disable=SC2154
# Actions of a person in a window of the viewer, with the expected results: a function and a line in WindowBehaviors.cmake each.
# DriveWindow.sh, which sets the variables, calls one of them, and ends the program by key Q where it still runs then.

KeysNAndBStepThroughTheFiles() {
  make sphere first.ply
  make plane second.ply
  open_viewer first.ply second.ply
  key n
  said "file 2 of 2: second.ply"
  key n
  said "file 1 of 2: first.ply"
  key b
  shows second.ply
}

KeyNSkipsAFileThatCannotBeRead() {
  make sphere first.ply
  echo "no cloud" >broken.ply
  make plane third.ply
  open_viewer first.ply broken.ply third.ply
  key n
  said "broken.ply: "
  said "file 3 of 3: third.ply"
  key b
  said "file 1 of 3: first.ply"
}

# What the window shows, and what was chosen for it, stays.
KeyNStaysWhereNoOtherFileCanBeRead() {
  make sphere good.ply
  echo "no cloud" >broken.ply
  open_viewer good.ply broken.ply
  key n
  said "broken.ply: "
  sleep 1 # for a file that must not be read
  never_said "file 1 of 2"
}

# The other file lies aside, so that at the place of the first one its box would have to pass the hand.
AnotherFileIsFeltByAFreeHand() {
  make sphere first.ply
  make box box.csv
  awk -F, -v OFS=, 'NR > 1 { $2 -= 0.3 } { print }' box.csv >aside.csv
  open_viewer first.ply aside.csv --device simulated --trace trace.csv
  key n
  said "file 2 of 2: aside.csv"
  sleep 1 # ticks with its scene
  key q
  ends_with 0 "key Q"
  said "trace: trace.csv"
  ! has_value 15 1 trace.csv || fail "the hand is pushed"
}

AChangedFileIsReadAgain() {
  make plane cloud.ply
  open_viewer cloud.ply --watch
  make sphere cloud.ply
  said "read again: cloud.ply"
}

ShiftAndDragTurnsTheModel() {
  make sphere cloud.ply
  open_viewer cloud.ply
  write_settings
  turn_model
  write_settings
  changed matrix || fail "the model did not turn"
}

KeyCtrlZTakesTheDragBack() {
  make sphere cloud.ply
  open_viewer cloud.ply
  write_settings
  turn_model
  key ctrl+z
  write_settings
  same matrix || fail "the model stays turned"
}

# A thing of 160 units without intensities is offered in millimetres; the model stays where it is.
KeyUTakesTheUnitThatTheFileSeemsToHave() {
  make sphere small.csv
  awk -F, 'NR == 1 { print "x,y,z"; next } { print 4000 * $1 "," 4000 * $2 "," 4000 * $3 }' small.csv >thing.csv
  open_viewer thing.csv
  said "1 mm in the hand is"
  write_settings
  key u
  said "the file is taken to be in mm"
  write_settings
  is unit '"mm"' || fail "the settings do not have the unit"
  key u
  said "the file is taken to be in m"
  key q
  ends_with 0 "key Q"
  mv said.txt before.txt
  start_viewer thing.csv --config "$settings"
  shows thing.csv
  has_keys
  said "1 : "
  write_settings
  is unit '"mm"' || fail "the unit of the configuration is lost"
}

DragTurnsTheView() {
  make sphere cloud.ply
  open_viewer cloud.ply
  write_settings
  drag 320 150 360 166
  write_settings
  changed camera || fail "the camera did not turn"
  same matrix || fail "the model turned"
}

# With Ctrl or Alt a letter is another command.
LettersWithCtrlOrAltDoNothing() {
  make sphere cloud.ply
  open_viewer cloud.ply
  key ctrl+o alt+o ctrl+a alt+a ctrl+s alt+s ctrl+shift+x ctrl+q alt+q
  write_settings
  is figure false || fail "it drew the figure"
  is axes false || fail "it drew the axes"
  never_said screenshot
}

SliderSetsTheFriction() {
  make sphere cloud.ply
  open_viewer cloud.ply --device simulated
  key v
  until_true "the slider did not set the friction" friction_follows_the_slider
  ! grep -q '"voxel"' "$settings" || fail "a voxel size that nobody chose"
}
# To the middle of its way; before the slider is drawn the drag turns the view.
friction_follows_the_slider() {
  drag 535 240 579 240
  write_settings
  grep -qE '"mu-d": 0\.[45]' "$settings"
}

SliderSetsTheVoxelSize() {
  make sphere cloud.ply
  open_viewer cloud.ply --device simulated
  key v
  until_true "the slider did not set the voxel size" voxel_size_follows_the_slider
}
voxel_size_follows_the_slider() {
  drag 558 336 579 336
  write_settings
  grep -q '"voxel"' "$settings"
}

ABoundKeySavesAPicture() {
  make sphere cloud.ply
  open_viewer cloud.ply --bind "screenshot=s F2"
  key F2
  said "screenshot: pointhaptics-001.png"
  [[ -s pointhaptics-001.png ]] || fail "the screenshot is empty"
}

# In a PNG width and height are the four bytes each from the 17th on.
KeySSavesAPictureOfASizeOfItsOwn() {
  make sphere cloud.ply
  open_viewer cloud.ply --screenshot-size 1000x700
  key s
  said "screenshot: pointhaptics-001.png (1000x700)"
  [[ "$(od -An -tu1 -j16 -N8 pointhaptics-001.png | tr -s ' ')" == " 0 0 3 232 0 0 2 188" ]] ||
    fail "the picture is not 1000x700"
  write_settings
  is screenshot-size '"1000x700"' || fail "the settings do not have the size"
  is size '"640x480"' || fail "the window has another size"
  drag 320 150 360 166
  write_settings
  changed camera || fail "the window does not go on"
}

# Other keys work meanwhile, and the horizon stays level.
ShiftTTurnsTheView() {
  make sphere cloud.ply
  open_viewer cloud.ply --up z --device none
  key 1 T
  said "turntable: turning"
  write_settings
  until_true "the view does not turn" has_turned
  [[ "$(setting camera "$settings" | tr -d ']' | awk -F, '{ print ($NF > 0.999999) }')" == 1 ]] || fail "the horizon is not level"
  same matrix || fail "the model turns"
  key k
  said "colour map: viridis"
  key T
  said "turntable: stopped"
  write_settings
  write_settings
  same camera || fail "the view still turns"
}
has_turned() {
  write_settings
  changed camera
}

# A sphere of 25 mm. Seen from the front xmax is at the right edge of the sphere, half as high as the picture.
ShiftCDragsTheClippingBox() {
  make sphere cloud.ply
  open_viewer cloud.ply --up z --device none
  key 1
  write_settings
  [[ "$(setting clip "$settings")" == "" ]] || fail "it is clipped already"
  key C
  said "clipping box: drag its handles"
  write_settings
  [[ "$(setting clip "$settings")" == "" ]] || fail "the box that is shown clips"
  until_true "no handle was dragged" drags_xmax
  same camera || fail "the view has turned"
  clip_is 2 '< 0.0237'
  clip_is 1 '< -0.0247'
  key Tab comma comma
  said "clipping box: keys move ymin"
  said "clipping box: ymin"
  write_settings
  clip_is 3 '> -0.0235'
  clip_is 3 '< -0.0225'
  key Delete
  said "clipping box: none"
  write_settings
  [[ "$(setting clip "$settings")" == "" ]] || fail "the clipping stays"
  same camera || fail "the view has turned"
}
# From where the handle may be; the mouse moves on as a hand does.
drags_xmax() {
  local x
  for x in 520 528 536 544 552 560; do
    xdotool mousemove --window "$window" "$x" 240 mousedown 1 mousemove --window "$window" $((x - 20)) 240 \
      mousemove --window "$window" $((x - 60)) 240 mouseup 1
    sleep 0.5 # for what a hit makes it say
    if grep -qF "clipping box: xmax" said.txt; then break; fi
    key 1 # a miss has turned the view
  done
  write_settings
  changed clip
}
# clip_is NUMBER CONDITION: of the six in the settings.
clip_is() {
  awk -v "n=$1" -F'[][,]' "{ exit !(\$(n + 1) $2) }" <<<"$(setting clip "$settings")" || fail "number $1 of the box is not $2: $(setting clip "$settings")"
}

# ALSA plays into a file, or is not there and the window says so.
KeyF8MakesTheTouchHeard() {
  make sphere cloud.ply
  printf 'pcm.!default { type file slave.pcm { type null } file "%s/heard.raw" format "raw" }\n' "$folder" >asound.conf
  environment=("ALSA_CONFIG_PATH=$folder/asound.conf")
  open_viewer cloud.ply
  write_settings
  is sound false || fail "there is sound already"
  key F8
  until_true "it says nothing of sound" grep -qE "sound: as loud|sound needs libasound" said.txt
  if grep -qF "sound: as loud" said.txt; then
    until_true "nothing is played" test -s heard.raw
    write_settings
    is sound true || fail "the settings do not have it"
    key F8
    said "sound: off"
  fi
}

ShiftSShowsTwoEyes() {
  make sphere cloud.ply
  open_viewer cloud.ply --device none --stereo red-blue
  picture 1
  key S
  said "stereo: none"
  picture 2
  ! cmp -s pointhaptics-001.png pointhaptics-002.png || fail "the picture is the same"
  key S
  said "stereo: red-blue"
  write_settings
  is stereo '"red-blue"' || fail "the settings do not have it"
}

# Where nobody says how many dots an inch has: as --font-scale 2 on a small screen, to the byte.
TextsAreTwiceAsLargeOnAScreenOf4K() {
  make sphere cloud.ply
  kill "$server"
  start_server 1400x1300
  open_viewer cloud.ply --device none --up z --font-scale 2
  xdotool windowsize --sync "$window" 1300 1200
  key o h
  settled_picture 1
  mv "$shown" small.png
  rm pointhaptics-*.png
  key q
  ends_with 0 "key Q"
  kill "$server"
  start_server 3840x2160
  open_viewer cloud.ply --device none --up z
  xdotool windowsize --sync "$window" 1300 1200
  key o h
  settled_picture 1
  cmp -s small.png "$shown" || fail "the texts are not twice as large"
}

KeyAShowsTheAxes() {
  make sphere cloud.ply
  open_viewer cloud.ply
  write_settings
  is axes false || fail "there are axes already"
  key a
  write_settings
  is axes true || fail "there are none"
}

KeyOMakesTheFigure() {
  make sphere cloud.ply
  open_viewer cloud.ply
  write_settings
  is figure false || fail "it is a figure already"
  key o
  write_settings
  is figure true || fail "it is none"
}

# The figure has no words, but the help comes for whoever asks for it.
# picture NUMBER [KEY]: presses the keys, and s; the picture of that number is there then.
picture() {
  key ${2:-} s
  said "screenshot: $(picture_name "$1")"
}
picture_name() { printf 'pointhaptics-%03d.png' "$1"; }

# settled_picture NUMBER: as work behind still changes some pixels, key s until three pictures are the same. NUMBER is the
# first one's; the name of the last comes into $shown, its number into $shot.
settled_picture() {
  local same=0 before
  shot=$1
  picture "$shot"
  while ((same < 2)); do
    ((shot < 6)) || fail "the picture does not settle"
    before="$(picture_name "$shot")"
    shot=$((shot + 1))
    picture "$shot"
    shown="$(picture_name "$shot")"
    if cmp -s "$before" "$shown"; then same=$((same + 1)); else same=0; fi
  done
}

KeyHShowsTheHelpInAFigure() {
  make sphere cloud.ply
  open_viewer cloud.ply
  key o
  settled_picture 1
  local page=0
  picture $((shot + 1)) h
  ! cmp -s "$shown" "$(picture_name $((shot + 1)))" || fail "there is no help"
  until cmp -s "$shown" "$(picture_name $((shot + 1 + page)))"; do
    ((page < 4)) || fail "the help stays"
    page=$((page + 1))
    picture $((shot + 1 + page)) h
  done
}

KeyMGoesThroughTheColors() {
  make plane cloud.ply
  open_viewer cloud.ply
  write_settings
  [[ "$(setting color-by "$settings")" == "" ]] || fail "a colour that nobody chose"
  key m
  said "coloured by height"
  key m
  said "coloured by density"
  write_settings
  is color-by '"Density"' || fail "the settings do not have the colours"
  key m m
  said "coloured by residual, as soon as it is computed"
  until_true "the status still waits for Residual" grep -qxF "coloured by residual" said.txt
  key m
  said "coloured by clay"
}

KeyKChangesTheColors() {
  make plane cloud.ply
  open_viewer cloud.ply --color-by density
  key k
  said "colour map: viridis"
  picture 1
  key k
  said "colour map: cividis"
  picture 2
  ! cmp -s pointhaptics-001.png pointhaptics-002.png || fail "the picture is the same"
  write_settings
  is color-map '"cividis"' || fail "the settings do not have the colours"
}

# The bar is at the right edge, half as high as the window.
ADragOnTheColorBarChangesItsRange() {
  make sphere cloud.ply
  open_viewer cloud.ply --color-by height
  write_settings
  before="$settings"
  # The bar stands at the edge of the window, whatever its title.
  xdotool mousemove --window "$window" 616 200 mousedown 1
  sleep 0.3
  xdotool mousemove --window "$window" 616 190
  sleep 0.3
  xdotool mousemove --window "$window" 616 180 mouseup 1
  said "colours from"
  write_settings
  same camera || fail "the view has turned"
  changed color-range || fail "the settings do not have the range"
  key K
  said "colour map over all values"
}

# The plane seen from above fills the window: a click on it always meets a point. Escape ends measuring, not the program.
ShiftDMeasuresBetweenTwoClicks() {
  make plane cloud.ply
  open_viewer cloud.ply --up z --device none
  key 5
  write_settings
  click 260 240
  never_said distance
  key D
  said "measuring: click on two points"
  click 260 240
  said "measuring: click on the second point"
  click 380 240
  said "distance: "
  write_settings
  [[ "$(setting measure "$settings" | tr -cd ,)" == ",,,,," ]] || fail "the settings do not have the distance"
  same camera || fail "the view has turned"
  drag 300 200 340 220
  write_settings
  changed camera || fail "a drag does not turn the view"
  same measure || fail "a drag has measured"
  click 260 240
  until_true "the third click does not begin anew" has_second_start
  key Escape
  said "measuring: ended"
  write_settings
  [[ "$(setting measure "$settings")" == "" ]] || fail "the distance stays"
}
has_second_start() { (($(grep -cF "measuring: click on the second point" said.txt) == 2)); }

# The means have no values of an array that only the points were read for.
KeyMOffersTheMeansWhatTheyHave() {
  awk 'BEGIN { print "x,y,z,Intensity"; for (i = 0; i < 9999; ++i) print i % 99, int(i / 99), i % 7, i % 5 }' >cloud.csv
  open_viewer cloud.csv --felt
  local step
  for step in 1 2 3 4 5 6; do key m; done
  said "coloured by residual"
  key m
  said "coloured by height"
  never_said "coloured by Intensity"
  key d m m m m m m
  said "coloured by Intensity"
}

KeyDShowsTheMeansThatAreFelt() {
  make sphere cloud.ply
  open_viewer cloud.ply
  write_settings
  is felt false || fail "the means are shown already"
  key s d
  said "shown: the voxel means that are felt"
  key s
  said "screenshot: pointhaptics-002.png"
  ! cmp -s pointhaptics-001.png pointhaptics-002.png || fail "the picture is the same"
  write_settings
  is felt true || fail "the settings do not have it"
  key d
  said "shown: the points of the file"
}

# Keys 1 to 7 look along the axes of a cloud, and key E goes back to the first view.
KeysOneToSevenLookAlongTheAxes() {
  local each first
  make sphere cloud.ply
  open_viewer cloud.ply --up z
  write_settings
  first="$(setting camera "$settings")"
  for each in 1 2 3 4 5 6 7; do
    key "$each"
    write_settings
    setting camera "$settings" >>cameras.txt
    echo >>cameras.txt
  done
  [[ "$(sides_seen | tr '\n' ' ')" == "-y +y -x +x +z -z +x-y+z " ]] || fail "seen from: $(sides_seen)"
  key e
  write_settings
  [[ "$(setting camera "$settings")" == "$first" ]] || fail "key E does not bring the first view back"
  same matrix || fail "the model moved"
}

# Prints for each row of cameras.txt on which side of its focal point the camera is.
sides_seen() {
  sed 's/.*\[//' cameras.txt | awk -F, 'NF {
    sides = ""
    for (i = 1; i <= 3; ++i) {
      offset = $i - $(i + 3)
      sides = sides (offset > 0.01 ? "+" : offset < -0.01 ? "-" : "") (offset * offset > 0.0001 ? substr("xyz", i, 1) : "")
    }
    print sides
  }'
}

# Turning the camera aside keeps the horizon; a view from below with another up does not.
KeyRLevelsTheHorizon() {
  make sphere cloud.ply
  open_viewer cloud.ply --camera 0,-0.4,0,0,0,0,0.7,0,0.7
  write_settings
  key r
  write_settings
  changed camera || fail "the camera stays as it was"
  [[ "$(setting camera "$settings" | tr -d ']' | awk -F, '{ print ($(NF-2) < 1e-6 && $(NF-2) > -1e-6 && $NF > 0.9) }')" == 1 ]] ||
    fail "the horizon is not level: $(setting camera "$settings")"
}

ShiftPChangesTheProjection() {
  make sphere cloud.ply
  open_viewer cloud.ply
  write_settings
  key s P s
  said "parallel projection"
  said "screenshot: pointhaptics-002.png"
  ! cmp -s pointhaptics-001.png pointhaptics-002.png || fail "the picture is the same"
  write_settings
  is projection '"parallel"' || fail "the settings do not have it"
  same camera || fail "the camera moved"
  key P
  said "perspective projection"
}

# With and without a window manager.
KeyF11FillsTheScreen() {
  local manager=""
  make sphere cloud.ply
  if command -v openbox >/dev/null; then
    XDG_CONFIG_HOME="$folder" HOME="$folder" openbox >/dev/null 2>&1 &
    manager=$!
    sleep 0.5 # no condition: without it the window is managed later, which is well too
  fi
  open_viewer cloud.ply
  fills_and_returns
  key q
  ends_with 0 "key Q"
  if [[ -n "$manager" ]]; then
    kill "$manager"
    wait "$manager" 2>/dev/null || true
    open_viewer cloud.ply
    fills_and_returns
  fi
}
fills_and_returns() {
  key F11
  until_true "the window does not fill the screen" has_size 800x600
  key 5 F11
  until_true "the window does not go back" has_size 640x480
}
has_size() { [[ "$(xdotool getwindowgeometry "$window" | sed -n 's/.*Geometry: //p')" == "$1" ]]; }

PlusAndMinusChangeThePoints() {
  make sphere cloud.ply
  open_viewer cloud.ply
  key s plus plus
  said "point size: 1.56 times"
  key s
  said "screenshot: pointhaptics-002.png"
  ! cmp -s pointhaptics-001.png pointhaptics-002.png || fail "the picture is the same"
  write_settings
  is point-scale 1.5625 || fail "the settings do not have it"
  key minus minus
  said "point size: 1 times"
}

BracketsChangeTheShadingByDepth() {
  make sphere cloud.ply
  open_viewer cloud.ply
  key bracketright
  said "shading by depth: strength 2"
  write_settings
  is edl-strength 2.0 || fail "the settings do not have it"
  key bracketleft bracketleft bracketleft bracketleft bracketleft
  said "shading by depth: off"
}

ShiftGChangesTheBackground() {
  make sphere cloud.ply
  open_viewer cloud.ply
  key G
  said "background: light"
  key G G G
  said "background: dark"
  key G
  write_settings
  is background '"light"' || fail "the settings do not have it"
}

KeyLLightsTheCloud() {
  make sphere cloud.ply
  open_viewer cloud.ply
  write_settings
  is ambient false || fail "it is lit already"
  key l
  write_settings
  is ambient true || fail "it is not"
}

# The hand holds the model as long as key F1 is down, and goes aside with the mouse.
TheHandHoldsTheModelWhileKeyF1IsDown() {
  make sphere cloud.ply
  open_viewer cloud.ply --device simulated
  move_to 300 150
  write_settings
  key f
  xdotool keydown F1
  sleep 0.8 # no condition: until the server repeats the key, as it does after 0.66 s
  move_to 360 150
  until_true "the hand did not shift the model" model_is_shifted
  xdotool keyup F1
  until_true "the hand still holds the model" model_rests
  move_to 300 150
  sleep 0.3 # no condition: nothing may happen
  write_settings
  same matrix || fail "the hand goes on with the model"
}
model_is_shifted() {
  write_settings
  changed matrix
}
model_rests() {
  write_settings
  same matrix
}

# From the left into a sphere: the touch pushes the pointer back.
KeyF9GivesHighContrast() {
  make sphere cloud.ply
  open_viewer cloud.ply --device simulated --theme high-contrast
  write_settings
  is theme '"high-contrast"' || fail "the option is not in force"
  key F9
  said "theme: usual"
  key F9
  said "theme: high-contrast"
  key F9
  write_settings
  is theme '"usual"' || fail "the settings do not have it"
}

TheTouchPushesThePointer() {
  make sphere cloud.ply
  open_viewer cloud.ply --device simulated
  move_to 162 180
  key f g
  for ((i = 0; i < 8; ++i)); do key Page_Up; sleep 0.1; done # deeper: a flank pushes aside
  until_true "the touch did not push the pointer" touch_pushes
}
# Each time from the flank, which faces left; the hand comes there and back in some tenths of a second.
touch_pushes() {
  move_to 162 180
  sleep 0.3
  move_to 260 180
  sleep 0.5
  (($(xdotool getmouselocation --shell | sed -n 's/^X=//p') < 245))
}

# Hand mode begins above the sphere, keys alone take the hand into it, and the model stays.
KeysAloneTouchTheCloud() {
  make sphere cloud.ply
  open_viewer cloud.ply --device simulated
  move_to 320 180
  key f j
  said "recording to pointhaptics-001.csv"
  for ((i = 0; i < 16; ++i)); do key Page_Up; sleep 0.2; done
  key Left Up Right Down
  key j
  said "recording: pointhaptics-001.csv"
  [[ "$(awk -F, '!/^#/ && ++row == 2 { print $15 }' pointhaptics-001.csv)" == 0 ]] || fail "the hand began in the sphere"
  has_value 15 1 pointhaptics-001.csv || fail "the keys did not take the hand into the sphere"
  (($(grep -c '^# tick .*: scene' pointhaptics-001.csv) == 1)) || fail "the model moved"
  feels_again pointhaptics-001.csv
}

# Two presses of a key, and in between the hand touches the sphere, and the model is zoomed: feel answers with the same bits.
# Markers are kept where they come before the first tick of the table, and just before the end.
KeyJRecordsWhatFeelFeelsAgain() {
  make sphere cloud.ply
  open_viewer cloud.ply --device simulated
  move_to 175 180
  key f
  xdotool key j space
  said "recording to pointhaptics-001.csv"
  said "marker 1"
  until_true "nothing was touched" touches
  key ctrl+minus
  touches
  xdotool key space j
  said "marker 2"
  said "recording: pointhaptics-001.csv"
  feels_again pointhaptics-001.csv
  has_value 15 1 pointhaptics-001.csv || fail "the recording has no contact"
  has_value 18 1 pointhaptics-001.csv || fail "the recording has no first marker"
  has_value 18 2 pointhaptics-001.csv || fail "the recording has no last marker"
  (($(grep -c '^# tick .*: scene' pointhaptics-001.csv) > 1)) || fail "the recording has no motion of the model"
}
# Above the flank of the sphere and into it; the status is what a person sees.
touches() {
  move_to 175 180
  sleep 0.3 # no condition: the hand comes there and back in some tenths of a second
  move_to 240 180
  sleep 0.5
}
# has_value COLUMN VALUE RECORDING: in a row. A grep that ends at the first hit would break the pipe before it.
has_value() { awk -F, -v column="$1" -v value="$2" '!/^#/ && $column == value { found = 1 } END { exit !found }' "$3"; }
# feels_again RECORDING
feels_again() {
  "$program" feel --replay "$1" -o again.csv >felt.txt || fail "feel --replay failed"
  grep -qF "to the last bit" felt.txt || fail "$(cat felt.txt)"
  cmp <(grep -v '^#' "$1" | cut -d, -f1-15) <(cut -d, -f1-15 again.csv) || fail "other forces"
}

# The cloud has no file that a replay could find: a copy is beside the recording.
ARecordingOfStandardInputKeepsItsCloud() {
  make sphere cloud.ply
  input=cloud.ply
  start_viewer - --device simulated
  shows "standard input"
  has_keys
  move_to 175 180
  key f j
  said "recording to pointhaptics-001.csv"
  until_true "nothing was touched" touches
  key j
  said "recording: pointhaptics-001.csv"
  key q
  ends_with 0 "key Q"
  cmp cloud.ply pointhaptics-001.cloud || fail "another cloud was kept"
  rm cloud.ply
  feels_again pointhaptics-001.csv
  has_value 15 1 pointhaptics-001.csv || fail "the recording has no contact"
}

AWindowShowsARecording() {
  make sphere cloud.ply
  open_viewer cloud.ply --device simulated --record rec.csv
  move_to 175 180
  key f
  touches
  key q
  ends_with 0 "key Q"
  said "recording: rec.csv"
  feels_again rec.csv
  start_viewer --replay rec.csv
  shows cloud.ply
  has_keys
  said "to the last bit"
}

ADroppedFileIsShown() {
  make sphere cloud.ply
  make torus dropped.ply
  open_viewer cloud.ply
  "$DROP_FILE" "$window" 320 100 "$folder/dropped.ply" || fail "the drop did not end well"
  shows dropped.ply
}

ABadDropKeepsTheCloud() {
  make sphere cloud.ply
  open_viewer cloud.ply
  "$DROP_FILE" "$window" 320 100 "$folder/nothing.ply" || fail "the drop did not end well"
  said "nothing.ply"
  shows cloud.ply
}

TheSettingsAreRemembered() {
  make sphere cloud.ply
  open_viewer cloud.ply
  key q
  ends_with 0 "key Q"
  grep -q '"stiffness"' state/pointhaptics/view.json || fail "the settings are not kept"
  "$program" view cloud.ply --recent --write-config recent.json >said.txt
  grep -q '"size": "640x480"' recent.json || fail "--recent does not bring them back"
}

WrittenSettingsBringTheViewBack() {
  local name
  make sphere cloud.ply
  open_viewer cloud.ply --bind "screenshot=s F2"
  drag 320 150 360 166
  turn_model
  key a o P G plus
  write_settings
  key q
  ends_with 0 "key Q"
  open_viewer cloud.ply --config "$settings"
  write_settings
  for name in camera matrix bind size axes figure projection background point-scale; do
    same "$name" || fail "--config lost $name"
    [[ -n "$(setting "$name" "$settings")" ]] || fail "no $name in the written settings"
  done
}

CtrlCEndsTheProgram() {
  make sphere cloud.ply
  open_viewer cloud.ply
  kill -INT "$viewer"
  ends_with 130 "Ctrl+C"
}

# A file that is read for long.
EscapeKeepsTheFormerCloud() {
  make sphere first.ply
  make plane slow.ply
  hold_slow_file
  open_viewer first.ply slow.ply
  key n
  is_reading
  key Escape
  sleep 1 # a frame that is drawn keeps the key waiting, and the file is read at once
  let_it_read
  said "slow.ply: not read, it was cancelled"
  shows first.ply
  never_said "file 2 of 2"
}

EscapeLeavesOneThingAfterTheOther() {
  make sphere cloud.ply
  open_viewer cloud.ply
  key h Escape f Escape C
  said "clipping box: drag its handles"
  key Escape
  said "clipping box: hidden"
  key j
  said "recording"
  key Escape
  said "once more ends it and quits"
  key Escape
  ends_with 0 "the second Escape"
}

EscapeCancelsTheFirstFile() {
  make sphere slow.ply
  open_held slow.ply
  key Escape
  let_it_read
  ends_with 130 "Escape"
  said "slow.ply: reading was stopped on request"
}

KeysBeforeTheFirstFileActOnIt() {
  make sphere slow.ply
  open_held slow.ply
  key w
  let_it_read
  shows slow.ply
  said "settings: pointhaptics-001.json"
  written=1 settings=pointhaptics-001.json
  write_settings
}

CtrlCCancelsTheFirstFile() {
  make sphere slow.ply
  open_held slow.ply
  kill -INT "$viewer"
  let_it_read
  ends_with 130 "Ctrl+C"
}

KeyQCancelsTheFirstFile() {
  make sphere slow.ply
  open_held slow.ply
  key ctrl+q alt+q # other commands
  key q
  let_it_read
  ends_with 130 "key Q"
  said "slow.ply: reading was stopped on request"
}

TheCloseButtonCancelsTheFirstFile() {
  make sphere slow.ply
  open_held slow.ply
  "$CLOSE_WINDOW" "$window" || fail "the window with the bar does not listen for its close button"
  let_it_read
  ends_with 130 "the close button"
  said "slow.ply: reading was stopped on request"
}

# The window that opened with the bar, before its first cloud was read, hears what any other does.
TheWindowHearsKeysAfterASlowFirstFile() {
  make sphere slow.ply
  open_held slow.ply
  key ctrl+q alt+q # other commands than Q
  let_it_read
  shows_in_the_same_window slow.ply
  write_settings
  turn_model
  key 5
  write_settings
  changed matrix || fail "the model did not turn"
  changed camera || fail "key 5 does not look from above"
}
shows_in_the_same_window() {
  local waiting="$window"
  shows "$1"
  [[ "$window" == "$waiting" ]] || fail "the window was replaced by another one"
  has_keys
}

TheWindowHearsItsCloseButtonAfterASlowFirstFile() {
  make sphere slow.ply
  open_held slow.ply
  let_it_read
  shows_in_the_same_window slow.ply
  "$CLOSE_WINDOW" "$window" || fail "the window does not listen for its close button"
  ends_with 0 "the close button"
  never_said "X connection"
}

# A window goes on to the next file, and says which one it left out.
AFirstFileThatCannotBeReadIsSkipped() {
  make sphere good.ply
  echo "no cloud" >slow.ply
  open_held slow.ply good.ply
  let_it_read
  shows_in_the_same_window good.ply
  said "warning: skipped: slow.ply: "
  key n
  said "pointhaptics view: slow.ply: "
}

# The hand touches from the first tick of the recording that key J asks for: it has no tick, and the trace has all.
QuittingInTouchKeepsTheTrace() {
  make sphere cloud.ply
  open_viewer cloud.ply --device simulated --trace trace.csv
  move_to 320 180
  key f
  until_true "the hand does not touch" presses_until_it_touches
  key j
  said "recording begins when the hand lets go"
  key q
  ends_with 0 "key Q"
  said "trace: trace.csv"
  said "nothing was recorded"
  has_value 15 1 trace.csv || fail "the trace has no contact"
  [[ ! -e trace.csv.part && ! -e pointhaptics-001.csv && ! -e pointhaptics-001.csv.part ]] || fail "a part is left"
}

presses_until_it_touches() {
  key Page_Up
  has_value 15 1 trace.csv.part
}

# Study.md as it is, with two trials of each condition: a person slides over the sphere, presses Space and quits.
AStudyIsRunAndAnalysed() {
  local trial step
  if ! "$PYTHON" -c "import numpy" 2>/dev/null; then
    echo "skipped: no NumPy (package python3-numpy)"
    exit 77
  fi
  make sphere sphere.ply
  sed 's/REPEATS = 4/REPEATS = 2/' "$STUDY_BLOCKS/Study.py" >study.py
  mkfifo answers
  PATH="$(dirname -- "$program"):$PATH" "$PYTHON" study.py 7 --size 640x480 --device simulated <answers >said.txt 2>&1 &
  viewer=$!
  exec 9>answers
  for trial in 1 2 3 4; do
    said "trial $trial of 4"
    echo >&9
    shows sphere.ply
    has_keys
    move_to 175 180
    key f
    sleep 0.3
    for ((step = 0; step < 40; ++step)); do
      move_to $((step < 10 ? 175 + 6 * step : 235)) $((180 + 2 * step))
      sleep 0.03
    done
    key space
    until_true "there is no marker in trial $trial" said_times "$trial" "marker 1"
    key q
    until_true "the window stays" is_gone sphere.ply
  done
  ends_with 0 "the last trial"
  for trial in 1 2 3 4; do
    grep -qE "^# marker 1: trial $trial: (smooth|rough)$" "p07-0$trial.csv" || fail "recording $trial has no marker"
  done
  [[ "$(grep -c ",smooth," p07.csv) $(grep -c ",rough," p07.csv)" == "2 2" ]] || fail "$(cat p07.csv)"
  "$PYTHON" "$STUDY_BLOCKS/Study.2.py" >said.txt 2>&1 || fail "the analysis ended with an error"
  awk -F'[ ,]+' '/^friction/ { found = $3 > 0.05 && $3 < 0.2 && $5 > 0.4 && $5 < 0.7 } END { exit !found }' said.txt ||
    fail "the friction is not that of the conditions"
  [[ "$(wc -l <trials.csv)" == 5 ]] || fail "trials.csv: $(cat trials.csv)"
}
# said_times COUNT WORDS: so many lines have the words.
said_times() { (($(grep -cF -- "$2" said.txt) == $1)); }
is_gone() { [[ -z "$(xdotool search --name "PointHaptics: $1")" ]]; }

ADoubleClickSetsThePivot() {
  make sphere cloud.ply
  open_viewer cloud.ply --up z --device none
  key 1
  write_settings
  xdotool mousemove --window "$window" 380 200 click --repeat 2 --delay 60 1
  said "the view turns about the point in the middle"
  write_settings
  changed camera || fail "the camera stays"
  xdotool mousemove --window "$window" 20 400 click --repeat 2 --delay 60 1
  said "no point is there to turn about"
}

KeyF5WalksThroughTheCloud() {
  make sphere cloud.ply
  open_viewer cloud.ply --up z --device none
  key 1
  write_settings
  key F5
  said "walking: w, a, s, d go"
  key w w a Prior
  drag 320 200 360 180
  key F5
  said "walking: stopped"
  write_settings
  changed camera || fail "nobody walked"
  same matrix || fail "the model moved"
  key F5 Escape
  key w # writes settings again
  said "settings: pointhaptics-003.json"
  written=3
}

KeyF6ShowsAHeightProfile() {
  make sphere cloud.ply
  open_viewer cloud.ply --up z --device none --measure "-0.02,0,0,0.02,0,0"
  key F6
  said "profile: heights"
  key Escape
  write_settings
  grep -q '"measure"' "$settings" || fail "Escape took the line, too"
  key Escape F6
  said "no profile: "
}

KeyF7TurnsAnotherAxisUpAndKeepsIt() {
  make sphere cloud.ply
  open_viewer cloud.ply --device none
  key F7
  said "up: "
  write_settings
  local up
  up="$(setting up "$settings")"
  [[ -n "$up" ]] || fail "the settings do not have the axis"
  key q
  ends_with 0 "key Q"
  start_viewer cloud.ply --device none
  shows cloud.ply
  has_keys
  write_settings
  [[ "$(setting up "$settings")" == "$up" ]] || fail "the axis was not kept"
  key q
  ends_with 0 "key Q"
  start_viewer cloud.ply --device none --up "$(tr -d '"' <<<"${up#*:}")"
  shows cloud.ply
  has_keys
  key F7
  said "up: "
  write_settings
  [[ "$(setting up "$settings")" != "$up" ]] || fail "the key did not turn what --up asked for"
}

KeyF10HidesWhatIsOutsideOfTheColors() {
  make sphere cloud.ply
  open_viewer cloud.ply --device none --color-by Height --color-range 0.01,0.03
  key F10
  said "hidden: Height outside of 0.01 to 0.03"
  write_settings
  grep -q '"hide": "Height=:0.0' "$settings" || fail "the settings do not have what is hidden"
  key F10
  said "nothing is hidden"
  key q
  ends_with 0 "key Q"
  open_viewer cloud.ply --device none --color-by ProxyRadius
  key F10
  said "ProxyRadius is computed for the picture and hides nothing"
}

KeyF12SavesThePartThatIsShown() {
  make sphere cloud.ply
  open_viewer cloud.ply --device none --clip=-1,1,-1,1,0,1
  key F12
  said "saved: pointhaptics-001.ply, 1451 of 3000 points"
  [[ -s pointhaptics-001.ply ]] || fail "the file is empty"
}

KeyNShowsFilesAlone() {
  make sphere first.ply
  make plane second.ply
  start_viewer first.ply second.ply --together --color-by File --hide height=:0 --device none
  shows first.ply
  has_keys
  key n
  said "file 1 of 2, alone: first.ply"
  key n
  said "file 2 of 2, alone: second.ply"
  key n
  said "all files"
  key b
  write_settings
  grep -q '"hide": "Height=:0,File=:0,File=2:"' "$settings" || fail "the second file is not alone"
}

# A little longer, it stays where it is; fifty times as large, it would fill the view with one spot.
AGrownFileIsFittedAgain() {
  make sphere first.csv
  open_viewer first.csv --watch --clip=-9,9,-9,9,-0.01,9
  write_settings
  grow 1.05 && mv grown.csv first.csv
  said "read again: first.csv"
  write_settings
  same matrix || fail "a small change moved the model"
  same camera || fail "a small change moved the view"
  grow 50 && mv grown.csv first.csv
  until_true "the model keeps the fit of the small file" is_fitted_anew
  same clip || fail "the clip is gone"
}
grow() { awk -F, -v factor="$1" 'NR == 1 { print "x,y,z"; next } { print factor * $1 "," $2 * factor "," $3 * factor }' first.csv >grown.csv; }
is_fitted_anew() {
  write_settings
  changed matrix
}

AHiddenPartEndsTheRecordingAndSaysWhy() {
  make sphere cloud.ply
  open_viewer cloud.ply --device simulated --record rec.csv --color-by Height --color-range 0.01,0.03
  move_to 175 180
  key f
  touches
  key F10
  said "rec.csv: it ends early: what is felt was clipped or hidden"
  tail -n 1 rec.csv | grep -q "^# end: .*it ends early: what is felt was clipped or hidden" || fail "the file does not say why"
  feels_again rec.csv
}

# Two keys, the second before the first turn is seen.
ATurnKeepsColoursAndWhatIsHidden() {
  make sphere cloud.ply
  make plane second.ply
  start_viewer cloud.ply second.ply --together --color-by File --hide File=1 --device none --up z
  shows cloud.ply
  has_keys
  key F7 F7
  said "up: y"
  write_settings
  grep -q '"hide": "File=1"' "$settings" || fail "what was hidden is shown"
  grep -q '"color-by": "File"' "$settings" || fail "the colours are others"
}

WhereAllIsHiddenTheKeyThatShowsItIsNamed() {
  make sphere first.csv
  make plane plane.csv
  awk -F, -v OFS=, 'NR > 1 { $3 -= 0.1 } { print }' plane.csv >low.csv
  start_viewer first.csv low.csv --together --hide height=:-0.09 --up z --bind hide-outside=F3
  shows first.csv
  has_keys
  key n n
  said "file 2 of 2, alone: low.csv"
  key F12
  said "all points are hidden; F3 shows all"
  key F3
  said "nothing is hidden"
}

AnActionAfterEscapeHasWarnedIsNoSecondEscape() {
  make sphere cloud.ply
  open_viewer cloud.ply --device simulated --record rec.csv
  key Escape
  said "once more ends it and quits"
  key D Escape
  said "measuring: ended"
  key Escape
  until_true "it did not warn again" warned_twice
  key Escape
  ends_with 0 "the second Escape"
}
warned_twice() { (($(grep -c "once more ends it and quits" said.txt) == 2)); }

KeyMColoursTheMeansThatKeyDShows() {
  make plane plane.csv
  awk 'NR == 1 { print $0 ",r,g,b" } NR > 1 { print $0 ",9,99,9" }' plane.csv >cloud.csv
  open_viewer cloud.csv
  key d
  said "shown: the voxel means that are felt"
  key m
  said "coloured by height, as soon as it is computed"
  until_true "the means have no heights" grep -qxF "coloured by height" said.txt
}
