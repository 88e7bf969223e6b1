#!/usr/bin/env bash
# Proves that the naming rules bite: one wrong name of each kind must be found, and the notation of frames and units
# must not. naming_planted.sh ROOT SCRATCH. Exit 77 (skipped) without clang-tidy.
set -euo pipefail
root=$1 scratch=$2
command -v clang-tidy >/dev/null || { echo "SKIPPED: clang-tidy is not installed"; exit 77; }

mkdir -p "$scratch/app"
cp "$root/.clang-tidy" "$scratch"
cat >"$scratch/app/planted.cpp" <<'EOF'
namespace app {
constexpr double kRadius_mm = 1.0;
constexpr int WRONG_constant = 2;
enum class Mode { side_by_side, WrongEnumerator };
struct Pose {
  double p_P_mm = 0, X_WT = 0, force_P_N = 0, stiffness_N_per_mm = 0, damping_Ns_per_mm = 0;
  double wrongField = 0;
};
class wrong_class {};
class Servo {
 public:
  double distance_mm() const { return depth_mm_; }
  double wrong_Method() const { return wrongMember; }

 private:
  double depth_mm_ = 0, force_P_N_ = 0;
  double wrongMember = 0;
};
double voxelVolume_mm3(double n_W, double F_W_N, double wrongParameter) {
  const double R_AB = n_W, half_depth = F_W_N;
  double wrongVariable = R_AB * half_depth + wrongParameter;
  return wrongVariable;
}
void WrongFunction() {}
}  // namespace app
EOF

said=$(cd "$scratch" && clang-tidy --quiet app/planted.cpp -- -std=c++20 2>/dev/null) || true
found=$(grep -c 'error: invalid case style' <<<"$said" || true)
for name in WRONG_constant WrongEnumerator wrongField wrong_class wrong_Method wrongMember wrongParameter \
  wrongVariable WrongFunction; do
  grep -q "invalid case style for .* '$name'" <<<"$said" || { echo "not found: $name"; echo "$said"; exit 1; }
done
[ "$found" = 9 ] || { echo "expected 9 findings, got $found"; echo "$said"; exit 1; }
echo "9 of 9 planted names found"
