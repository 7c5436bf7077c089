// The lens of a refocusing.
#ifndef STARFOCUS_LIB_ENGINE_LENS_H_
#define STARFOCUS_LIB_ENGINE_LENS_H_

#include "lib/engine/engine.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Sets up the lens for params; SF_ERROR_BLUR_TOO_LARGE or SF_OK. The other fields of params must
// have been checked.
sf_status SetLens(const sf_params& params, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_LENS_H_
