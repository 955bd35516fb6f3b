#!/usr/bin/env bash
# SameBytes.sh CASE: what ranks write is byte for byte what the program pointhaptics writes.
source "$(dirname -- "${BASH_SOURCE[0]}")/support.sh"

# Points with floats, doubles whose magnitudes differ, integers, labels, normals, colours; some not finite, some outside.
arrays_csv() {
  awk 'BEGIN {
    srand(7)
    print "x,y,z,nx,ny,nz,red,green,blue,Classification,Temperature,Large,Time"
    for (i = 0; i < 6000; ++i) {
      t = i % 997 == 3 ? "nan" : (rand() - 0.5) * 10 ^ (i % 9)
      printf "%.9g,%.9g,%.9g,%.6g,%.6g,%.6g,%d,%d,%d,%d,%s,%d,%.17g\n", rand(), rand() * rand(), 0.1 * rand(),
        rand() - 0.5, rand() - 0.5, rand(), 255 * rand(), 255 * rand(), i % 256, 7 * rand() * rand(), t,
        2000000000 * rand(), 300000000 + i * 0.001
    }
  }' >arrays.csv
}

case "$1" in
  Points)
    "$PROGRAM" generate idol -n 20000 -o idol.ply >said
    same_bytes vtp resample idol.ply
    RANKS="3" same_bytes ply resample idol.ply --dims 40
    # Points far from all others are left out, and that is said in the same words, whoever has them.
    "$PROGRAM" convert idol.ply far.csv >said
    printf '1000000,0,0,0,0,1\n' >>far.csv
    RANKS="1 2 5" same_bytes vtp resample far.csv
    grep -q "warning: 1 of 20,001 points is far from all others; lattice and picture" warned-by-ranks ||
      fault "nothing is said of a far point: $(cat warned-by-ranks)"
    RANKS="2" same_bytes csv resample far.csv --voxel 10
    [[ ! -s warned-by-ranks ]] || fault "large voxels are no harm: $(cat warned-by-ranks)"
    ;;
  Arrays)
    arrays_csv
    same_bytes vtp resample arrays.csv --dims 12 --covariance
    RANKS="3 8" same_bytes csv resample arrays.csv --voxel 0.11
    ;;
  Options)
    arrays_csv
    RANKS="2 5" same_bytes vtp resample arrays.csv --dims 30,20,5000 --rotate 30,1,2,3 --minimum-points 2
    RANKS="4" same_bytes las resample arrays.csv --workspace 0.2,0.7,0,0.5,0,0.2 --unit mm --scale 1000
    RANKS="3" same_bytes pcd resample arrays.csv --json --dims 1
    # More ranks than points.
    printf 'x,y,z\n0,0,0\n1,2,3\n' >two.csv
    RANKS="4" same_bytes vtp resample two.csv
    ;;
  Representatives)
    arrays_csv
    for kind in nearest-to-mean nearest-to-center median; do
      RANKS="1 3" same_bytes vtp resample arrays.csv --dims 12 --representative "$kind" --covariance
    done
    RANKS="1 2 5" same_bytes vtp resample arrays.csv --dims 12 --representative nearest-to-mean --original-ids
    grep -q vtkOriginalPointIds expected.vtp || fault "no vtkOriginalPointIds"
    RANKS="4" same_bytes csv resample arrays.csv --dims 9 --representative median --rotate 30,1,2,3 --minimum-points 4
    for options in "--dims 9" "--dims 9 --minimum-points 5 --representative nearest-to-mean --workspace 0.2,0.7,0,0.5,0,0.2"; do
      # shellcheck disable=SC2086 # several words
      "$PROGRAM" resample arrays.csv -o expected.vtp --voxel-index expected-index.csv $options >said
      for ranks in 2 5; do
        # shellcheck disable=SC2086
        run_ranks "$ranks" resample arrays.csv -o out.vtp --voxel-index index.csv $options >said-by-ranks
        cmp expected.vtp out.vtp
        cmp expected-index.csv index.csv || fault "--voxel-index $options on $ranks ranks: other bytes"
      done
    done
    ;;
  Formats)
    # Read in parts, and whole: each gives the same points.
    arrays_csv
    "$PROGRAM" generate idol -n 5000 -o idol.ply >said
    for file in arrays.ply arrays.pcd arrays.las arrays.laz arrays.vtp; do
      "$PROGRAM" convert arrays.csv "$file" >said
      RANKS="2 3" same_bytes vtp resample "$file" --dims 12
    done
    # Splats: the faint ones are left out by all ranks, of all points.
    awk 'BEGIN {
      srand(3)
      print "ply\nformat ascii 1.0\nelement vertex 500"
      split("x y z f_dc_0 f_dc_1 f_dc_2 opacity", names, " ")
      for (i = 1; i <= 7; ++i) print "property float " names[i]
      print "end_header"
      for (i = 0; i < 500; ++i)
        printf "%g %g %g %g %g %g %g\n", rand(), rand(), rand(), rand(), rand(), rand(), (i > 300 && i % 3 ? -6 : 3)
    }' >splats.ply
    RANKS="1 2 3" same_bytes vtp resample splats.ply --dims 12
    RANKS="3" same_bytes vtp resample splats.ply --dims 12 --clip 0,0.01,0,1,0,1
    grep -q "133 of 500 splats are left out" warned-by-ranks || fault "not said: $(cat warned-by-ranks)"
    gzip -k idol.ply
    RANKS="3" same_bytes vtp bandwidth idol.ply.gz --density none
    ;;
  Bandwidth)
    "$PROGRAM" generate idol -n 6000 -o idol.ply >said
    same_bytes vtp bandwidth idol.ply
    "$PROGRAM" resample idol.ply -o means.vtp --dims 60 >said
    RANKS="2 3" same_bytes vtp bandwidth means.vtp
    # Each point thrice, the copies on several ranks.
    "$PROGRAM" convert idol.ply idol.csv >said
    (cat idol.csv && tail -n +2 idol.csv && tail -n +2 idol.csv) >thrice.csv
    RANKS="2 3" same_bytes vtp bandwidth thrice.csv
    RANKS="3" same_bytes ply bandwidth idol.ply --neighbors 40 --rule sheather-jones --density epanechnikov --r2 0.1
    RANKS="4" same_bytes csv bandwidth idol.ply --radius 0.02 --json
    ;;
  RealClouds)
    [[ -f "$SHARED_DATA/pine.las" ]] || {
      echo "skipped: no real clouds in $SHARED_DATA"
      exit 0
    }
    for cloud in office1.pcd samp11-utm.pcd pine.las; do
      RANKS="2 3" same_bytes vtp resample "$SHARED_DATA/$cloud" --covariance
    done
    RANKS="3" same_bytes las resample "$SHARED_DATA/pine.las" --voxel 0.5
    RANKS="3" same_bytes vtp bandwidth "$SHARED_DATA/samp11-utm.pcd"
    RANKS="2" same_bytes ply bandwidth "$SHARED_DATA/lucy_50k.ply" --density none
    ;;
  *) fault "unknown case $1" ;;
esac
