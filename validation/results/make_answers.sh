#!/bin/sh
# A published validation set again: made from its seed by the generator of its commit, its truth checked by the SHA-256
# on its page, and answered anew by the program of that commit.
# Usage: validation/results/make_answers.sh <seed> <folder> [--no-answers]
# The folder gets source/ (that commit, built), set/ and set/answers/. Answering 432 cases takes half an hour of one core.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
[ $# -ge 2 ] || { sed -n 2,5p "$0" >&2; exit 2; }
seed=$1
case $seed in
  20261122) commit=38cad05 counts="--singles 200 --none 40" hash=91cb8446eb7b0af939893c7e91ed11be4763adeae748c0451e7f1b7867b6bebc ;;
  2026112202) commit=51f6096 counts="--singles 680 --none 200" hash=bc5d5ba42d592c7d74342ffc0eb065bf1e03d591d7efe73a1327b84ddd80eb11 ;;
  2026112203) commit=1d8b8d2 counts="--singles 272 --none 100" hash=cd1e0f8f1352eb8b69ea3ca4bc7f75af0ec2655b9e288ec9cdb4df90eb7bc468 ;;
  2026112204) commit=74365a1 counts="--singles 272 --none 100" hash=cc3ef1f284fea046aecb70f89ea386a67ec136bb6ae36f7d1459c8648d34aa73 ;;
  2026112205) commit=9b5275d counts="--singles 272 --none 100" hash=6561b39076a88296128d880b41126620e738f1e04ba910b8673d37d935009b66 ;;
  *) echo "no validation set of seed '$seed' was published: see $root/validation/results/README.md" >&2; exit 2 ;;
esac
mkdir -p "$2"
out=$(cd "$2" && pwd)
[ -e "$out/source" ] || git -C "$root" worktree add --detach "$out/source" "$commit"
cmake -S "$out/source" -B "$out/build" -G Ninja -DCMAKE_BUILD_TYPE=Release
cmake --build "$out/build" --target rollrig_blind
# Programs of these commits have the words of then.
# shellcheck disable=SC2086
"$out/build/bin/rollrig_blind" bank --kind mixed --seed "$seed" --each 0 $counts --pairs 30 --outside 30 --out "$out/set"
echo "$hash  $out/set/truth.json" | sha256sum -c
[ "${3:-}" = --no-answers ] && exit 0
cmake --build "$out/build" --target rollrig
exec "$out/build/bin/rollrig" blind run "$out/set"
