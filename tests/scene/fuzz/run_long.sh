# Fuzzes the three kinds of scene file for SECONDS each, at the lowest priority; a finding stops it
# with a non-zero status and leaves its input in build/fuzz/found.
#   bash tests/scene/fuzz/run_long.sh 600
set -euo pipefail
seconds=${1:?usage: run_long.sh SECONDS}
cd "$(dirname "$0")/../../../build/fuzz"
mkdir -p found
./farlight-fuzz-seeds seeds
for format in json gltf glb; do
    mkdir -p "corpus/$format"
    nice -n 19 "./fuzz_$format" "corpus/$format" "seeds/$format" -max_total_time="$seconds" \
        -rss_limit_mb=4096 -max_len=65536 -timeout=20 -artifact_prefix=found/ -print_final_stats=1
done
