#include "tests/stress/setup.h"

#include <cmath>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

#include "lib/engine/engine.h"

namespace starfocus::stress {
namespace {

constexpr int kViews[] = {1, 5, 9, 17};
constexpr int kBlocks[] = {32, 64, 128, 256};
constexpr const char* kModes[] = {"frame", "benchmark", "block", "blur"};
// N or L changes at these radii: (9), (12).
constexpr double kThresholds[] = {0.5, 1, 2, 3, 4, 4 / 0.787, 6, 8, 12};

// Runs jobs one after the other in a shuffled order as any of the workers.
struct Shuffled {
  int workers;
  test::Random random;

  static int Run(void* self, sf_job job, void* data, int32_t count) {
    auto* runner = static_cast<Shuffled*>(self);
    std::vector<int32_t> order(static_cast<size_t>(count));
    for (int32_t i = 0; i < count; ++i) order[static_cast<size_t>(i)] = i;
    for (size_t i = order.size(); i > 1; --i) {
      std::swap(order[i - 1], order[runner->random.Next() % i]);
    }
    for (const int32_t index : order) job(data, index, runner->random.Int(0, runner->workers - 1));
    return 0;
  }
};

// An engine in memory of exactly the size it asked for.
class Workspace {
 public:
  Workspace(const sf_config& config, int poison) {
    size_t bytes = 0;
    status_ = sf_workspace_size(&config, &bytes);
    if (status_ != SF_OK) return;
    memory_.reset(::operator new (bytes, std::align_val_t{SF_ALIGNMENT}));
    if (poison >= 0) std::memset(memory_.get(), poison, bytes);
    status_ = sf_init(&config, memory_.get(), bytes, &engine_);
  }
  sf_status status() const { return status_; }
  sf_engine* get() const { return engine_; }

 private:
  struct Free {
    void operator()(void* memory) const {
      ::operator delete (memory, std::align_val_t{SF_ALIGNMENT});
    }
  };
  std::unique_ptr<void, Free> memory_;
  sf_engine* engine_ = nullptr;
  sf_status status_ = SF_OK;
};

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.9g", value);
  return text;
}

}  // namespace

double Setup::Radius() const {
  return params.aperture * std::max(std::fabs(config.disparity_min - params.focus),
                                    std::fabs(config.disparity_max - params.focus));
}

std::string Setup::Text() const {
  return std::to_string(config.width) + "x" + std::to_string(config.height) + ", " +
         std::to_string(config.views) + " views, " + kModes[params.mode] + ", rule " +
         std::to_string(params.rule) + ", disparity [" + Number(config.disparity_min) + ", " +
         Number(config.disparity_max) + "], focus " + Number(params.focus) + ", aperture " +
         Number(params.aperture) + ", max_blur " + Number(config.max_blur) + ", block " +
         std::to_string(config.largest_block) + ", layers " + std::to_string(config.max_layer) +
         ", deblocking " + std::to_string(config.deblocking) + ", theta " + Number(config.theta) +
         ", n_scale " + Number(config.n_scale) + (config.gather != 0 ? "" : ", nothing gathered");
}

std::string Variant::Text() const {
  return std::string(kernels == nullptr ? "best" : kernels->name) + ", " + std::to_string(workers) +
         " workers" +
         (stream ? ", streamed " + std::to_string(push_rows) + "/" + std::to_string(pull_rows)
                 : std::string(", whole")) +
         (skips != 0 ? "" : ", nothing skipped");
}

const std::vector<const simd::Kernels*>& AllKernels() {
  static const std::vector<const simd::Kernels*> all = [] {
    std::vector<const simd::Kernels*> found = {&simd::ReferenceKernels()};
    for (size_t i = 0; const simd::Kernels* kernels = simd::KernelsOfTarget(i); ++i) {
      found.push_back(kernels);
    }
    return found;
  }();
  return all;
}

Variant RandomVariant(test::Random* random) {
  const auto& all = AllKernels();
  Variant variant;
  variant.kernels = all[static_cast<size_t>(random->Int(0, static_cast<int>(all.size()) - 1))];
  variant.stream = random->Int(0, 1) == 1;
  variant.workers = random->Int(1, 4);
  variant.order = random->Int(0, 1) == 1 ? random->Next() + 1u : 0;
  variant.poison = random->Int(-64, 255);
  variant.push_rows = random->Int(1, 40);
  variant.pull_rows = random->Int(1, 40);
  variant.skips = random->Int(0, 1);
  return variant;
}

double RandomRadius(double largest, test::Random* random) {
  if (random->Int(0, 1) == 0) {
    const double threshold = kThresholds[random->Int(0, 8)];
    const double offset = random->Int(-2, 2) / 64.0;
    if (threshold + offset <= largest) return threshold + offset;
  }
  const double part = random->Unit();
  return largest * part * part;
}

void SetDepth(Depth depth, test::Scene* scene, test::Random* random) {
  if (depth == Depth::kPiecewise) return test::RandomDisparity(scene, random);
  if (depth == Depth::kNoisy) return test::NoisyDisparity(scene, random);
  const double low = scene->disparity_min, high = scene->disparity_max;
  const double base = random->Real(low, high);
  const bool slanted = depth == Depth::kSlanted;
  const double dx = slanted ? random->Real(-0.3, 0.3) : 0;
  const double dy = slanted ? random->Real(-0.3, 0.3) : 0;
  const int step_x = random->Int(1, 3), step_y = random->Int(1, 3);
  for (int y = 0; y < scene->height; ++y) {
    for (int x = 0; x < scene->width; ++x) {
      const bool odd = (x / step_x + y / step_y) % 2 == 1;
      const double value =
          depth == Depth::kAlternating ? (odd ? high : low) : base + dx * x + dy * y;
      scene->Disparity(x, y) =
          std::clamp(static_cast<float>(value), scene->disparity_min, scene->disparity_max);
    }
  }
}

void SetColours(Colours colours, test::Scene* scene, test::Random* random) {
  const int amplitude = 1 << random->Int(0, 7);
  for (auto& picture : scene->pictures) {
    int level = random->Int(0, 255);
    const int base = level;
    for (uint8_t& sample : picture) {
      if (colours == Colours::kSmooth) level += random->Int(-9, 9);
      if (colours == Colours::kExtreme) level = random->Int(0, 1) * 255;
      if (colours == Colours::kNoise) level = base + random->Int(-amplitude, amplitude);
      level = std::clamp(level, 0, 255);
      sample = static_cast<uint8_t>(level);
    }
  }
}

void FitBlur(Setup* setup) {
  const double radius = setup->Radius();
  setup->config.max_blur = radius > 0 ? radius : 0.5;
}

void RandomMode(int modes, Setup* setup, test::Random* random) {
  setup->params.mode = random->Int(0, modes - 1);
  setup->params.rule = random->Int(SF_RULE_DEFAULT, SF_RULE_SUBAPERTURE);
  // The benchmark's number of views grows with the square of twice the radius.
  if (setup->params.mode == SF_MODE_BENCHMARK && setup->Radius() > 4) {
    setup->params.mode = SF_MODE_BLOCK;
  }
}

void RandomLens(double radius, int modes, Setup* setup, test::Random* random) {
  const test::Scene& scene = setup->scene;
  const double half = 0.5 * (double{scene.disparity_max} - scene.disparity_min);
  const double centre = 0.5 * (double{scene.disparity_max} + scene.disparity_min);
  double aperture = random->Int(0, 1) == 0 ? 1 : random->Real(0.05, 1);
  if (aperture * half > radius) aperture = std::max(radius / half, 1e-6);
  const double offset = std::max(0.0, radius / aperture - half);
  const double focus = centre + (random->Int(0, 1) == 0 ? offset : -offset);
  setup->params = test::Params(focus, aperture);
  setup->config = test::ConfigFor(scene);
  setup->config.largest_block = kBlocks[std::min(random->Int(0, 3), random->Int(0, 3))];
  setup->config.max_layer = random->Int(0, 3) == 0 ? random->Int(0, 1) : 2;
  if (random->Int(0, 3) == 0) setup->config.deblocking = random->Int(0, 255);
  if (random->Int(0, 3) == 0) setup->config.theta = random->Real(SF_MIN_THETA, SF_MAX_THETA);
  // A cheap or a dear block makes the partition coarse or fine.
  if (random->Int(0, 1) == 0) setup->config.timing.block = 1u << random->Int(0, 26);
  FitBlur(setup);
  RandomMode(modes, setup, random);
}

Setup FlatSetup(int width, int height, double radius, test::Random* random) {
  Setup setup;
  setup.scene = test::EmptyScene(width, height, kViews[random->Int(0, 3)], 0, 0);
  RandomLens(radius, 4, &setup, random);
  setup.params.aperture = 1;
  setup.params.focus = random->Int(0, 1) == 0 ? radius : -radius;
  FitBlur(&setup);
  RandomMode(4, &setup, random);
  return setup;
}

Setup RandomSetup(const Bounds& bounds, test::Random* random) {
  const int low = std::min(bounds.size, random->Int(0, 3) == 0 ? bounds.size : 20);
  Setup setup;
  const double a = random->Real(-bounds.disparity, bounds.disparity);
  const double b = random->Int(0, 2) == 0 ? random->Real(-bounds.disparity, bounds.disparity)
                                          : std::clamp<double>(a + random->Real(-3, 3),
                                                               -bounds.disparity, bounds.disparity);
  setup.scene = test::EmptyScene(random->Int(1, low), random->Int(1, low),
                                 kViews[random->Int(0, 3)], static_cast<float>(std::min(a, b)),
                                 static_cast<float>(std::max(a, b)), random->Int(0, 3));
  SetDepth(static_cast<Depth>(random->Int(0, 4)), &setup.scene, random);
  SetColours(static_cast<Colours>(random->Int(0, 2)), &setup.scene, random);
  RandomLens(RandomRadius(bounds.radius, random), bounds.modes, &setup, random);
  if (random->Int(0, 3) == 0) setup.config.gather = 0;
  if (random->Int(0, 3) == 0) setup.config.n_scale = random->Real(SF_MIN_N_SCALE, SF_MAX_N_SCALE);
  return setup;
}

std::vector<uint8_t> Refocused(const Setup& setup, const Variant& variant, std::string* failure,
                               sf_report* report) {
  sf_config config = setup.config;
  config.streaming = variant.stream;
  config.max_workers = variant.workers;
  config.skips = variant.skips;
  Workspace engine(config, variant.poison);
  sf_status status = engine.status();
  test::Output out(setup.scene.width, setup.scene.height, 5);
  if (status == SF_OK) {
    if (variant.kernels != nullptr) {
      reinterpret_cast<EngineState*>(engine.get())->kernels = variant.kernels;
    }
    Shuffled shuffled = {variant.workers, test::Random(variant.order)};
    const sf_runner runner = variant.order == 0 ? nullptr : Shuffled::Run;
    status =
        variant.stream
            ? test::Stream(&engine, setup.params, setup.scene, &out, variant.push_rows,
                           variant.pull_rows, runner, &shuffled, report)
            : test::Refocus(&engine, setup.params, setup.scene, &out, runner, &shuffled, report);
  }
  if (status != SF_OK) {
    *failure = std::string(sf_status_string(status)) + " (" + variant.Text() + ")";
    return {};
  }
  if (!out.PaddingUntouched()) {
    *failure = "row padding overwritten (" + variant.Text() + ")";
    return {};
  }
  return out.Tight();
}

}  // namespace starfocus::stress
