#!/bin/bash -eu
# OSS-Fuzz runs this script with CC, CXX, CFLAGS, LIB_FUZZING_ENGINE, SRC and OUT. The script puts each target into OUT,
# with its seeds, its dictionary and the libraries that it needs. To run it by hand, from the folder of kerrd:
#
#   SRC=.. OUT=/tmp/out WORK=/tmp/work CC=clang CXX=clang++ CFLAGS=-fsanitize=fuzzer-no-link,address,undefined LIB_FUZZING_ENGINE=-fsanitize=fuzzer tests/fuzz/oss-fuzz/build.sh
source_folder=$(CDPATH= cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../../.." 2> /dev/null && pwd)
[ -f "$source_folder/tests/fuzz/meson.build" ] || source_folder=$SRC/kerrd # in the image this file is beside kerrd, not in it
build=${WORK:-/tmp}/kerrd-fuzz
mkdir -p "$OUT/lib"
rm -rf "$build"
meson setup "$build" "$source_folder" -Dtests=disabled -Dfuzz=true "-Dfuzz_engine=$LIB_FUZZING_ENGINE" -Db_lundef=false -Dbuildtype=plain
ninja -C "$build" fuzz

for program in "$build"/tests/fuzz/fuzz_*; do
  [ -f "$program" ] || continue
  name=${program##*/fuzz_}
  cp "$program" "$OUT/"
  # Copies libraries that are missing in the image that runs the targets. The image has the dynamic loader and the C
  # library.
  ldd "$program" | awk '$2 == "=>" && $3 ~ /^\// { print $3 }' | grep -Ev '/(libc|libm|libdl|libpthread|librt|libresolv|libgcc_s|ld-linux[^/]*)\.so' | xargs -r cp -nLt "$OUT/lib"
  ! command -v patchelf > /dev/null || patchelf --force-rpath --set-rpath '$ORIGIN/lib' "$OUT/fuzz_$name"
  seeds=()
  for folder in "$build/tests/fuzz/seeds/$name" "$source_folder/tests/fuzz/corpus/$name" "$source_folder/tests/fuzz/regressions/$name"; do
    [ ! -d "$folder" ] || seeds+=("$folder")
  done
  rm -f "$OUT/fuzz_${name}_seed_corpus.zip"
  python3 - "$OUT/fuzz_${name}_seed_corpus.zip" "${seeds[@]}" << 'END'
import pathlib, sys, zipfile
with zipfile.ZipFile(sys.argv[1], "w", zipfile.ZIP_DEFLATED) as out:
    for folder in map(pathlib.Path, sys.argv[2:]):
        for path in sorted(folder.iterdir()):
            out.write(path, f"{folder.parent.name}-{path.name}")
END
  dictionary=$build/tests/fuzz/seeds/$name.dict
  [ ! -f "$dictionary" ] || cp "$dictionary" "$OUT/fuzz_$name.dict"
done
for library in "$OUT"/lib/*; do
  ! command -v patchelf > /dev/null || patchelf --force-rpath --set-rpath '$ORIGIN' "$library"
done
