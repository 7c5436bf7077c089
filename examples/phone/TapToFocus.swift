// SPDX-License-Identifier: Apache-2.0
import CStarfocus

/// An error of the library.
struct StarfocusError: Error {
  let status: starfocus_status
}

func check(_ status: starfocus_status) throws {
  if status != STARFOCUS_OK { throw StarfocusError(status: status) }
}

/// Tap to focus: refocuses a frame at the pixel (x, y) that a user tapped. The frame has one view, for
/// example NV12, and a depth map of any type; starfocus_light_field_init makes an empty frame. `out`
/// receives the picture, in any format.
func tapToFocus(
  frame: inout starfocus_light_field, width: Int32, height: Int32, x: Int32, y: Int32,
  out: inout starfocus_image
) throws {
  var range = starfocus_disparity_stats()
  try check(starfocus_measure_disparity(&frame.depth, &range, nil))
  var config = starfocus_config()
  starfocus_config_init(&config)
  config.width = width
  config.height = height
  config.views = 1
  config.disparity_min = range.min
  config.disparity_max = range.max
  config.features |= STARFOCUS_FEATURE_IMAGES
  config.unknown = Int32(STARFOCUS_UNKNOWN_FILL.rawValue)
  var engine: OpaquePointer?
  try check(starfocus_create(&config, nil, &engine, nil))
  defer { starfocus_destroy(engine) }
  var prepared: OpaquePointer?
  try check(starfocus_prepare(engine, &frame, nil, 0, &prepared))
  defer { starfocus_destroy_prepared(prepared) }
  var params = starfocus_params()
  starfocus_params_init(&params)
  try check(starfocus_focus_at(&frame.depth, width, height, x, y, &params.focus, nil))
  var aperture = 0.0
  try check(starfocus_largest_aperture(engine, &params, &aperture))
  params.aperture = aperture
  try check(starfocus_refocus_prepared(engine, &params, prepared, &out, nil))
}
