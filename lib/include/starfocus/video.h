/* SPDX-License-Identifier: Apache-2.0 */
/** @file
 * Video: disparity maps that do not flicker. Programs that refocus single pictures do not need this
 * header. The conventions of starfocus.h apply.
 *
 * The maps of networks and sensors change from frame to frame where the scene does not, and the
 * blur changes with them. A stabiliser follows the motion of the picture and fuses the map of each
 * frame with the maps of the frames before it. It adds no delay: the map of a frame depends on this
 * frame and the frames before it. If maps are also repaired (starfocus_repair_disparity), stabilise
 * them first.
 *
 * @code
 * #include <starfocus/video.h>
 *
 * // Stabilises the map of the next frame of a video in place. Returns a starfocus_status.
 * int StabiliseFrame(starfocus_stabiliser* stabiliser, const starfocus_light_field* frame,
 *                    float* disparity, int width) {
 *   starfocus_disparity_output map = {0};
 *   map.disparity = disparity;
 *   map.disparity_stride = sizeof(float) * (size_t)width;
 *   return starfocus_stabilise_disparity(stabiliser, NULL, frame, &map, NULL);
 * }
 * @endcode
 *
 * Calls with one stabiliser must not run at the same time. The bytes of a map do not depend on the
 * runner, the number of workers or the SIMD target.
 */
#ifndef STARFOCUS_VIDEO_H_
#define STARFOCUS_VIDEO_H_

#include "starfocus/depth.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A stabiliser, which lives in memory of the caller and needs no destructor. */
typedef struct starfocus_stabiliser starfocus_stabiliser;

/** Computes the size of the memory of a stabiliser: about 27 bytes per pixel of the picture.
 *
 *  The functions of this header read these fields of starfocus_config: size, width, height,
 *  disparity_min, disparity_max and max_workers.
 *  @param config configuration
 *  @param bytes receives the size in bytes
 *  @param problem receives the cause of an error; may be null
 *  @return STARFOCUS_OK, an error of the configuration or STARFOCUS_ERROR_TOO_LARGE */
STARFOCUS_API starfocus_status starfocus_stabiliser_size(const starfocus_config* config,
                                                         size_t* bytes, starfocus_problem* problem);

/** Creates a stabiliser.
 *  @param config configuration, of which the stabiliser keeps a copy
 *  @param memory memory of the caller, aligned to STARFOCUS_ALIGNMENT, with any contents. The
 *         stabiliser uses it until the caller frees it
 *  @param bytes size of the memory, at least that of starfocus_stabiliser_size
 *  @param stabiliser receives the stabiliser, at the beginning of the memory
 *  @param problem receives the cause of an error; may be null
 *  @return STARFOCUS_OK, an error of the configuration or of the memory, or
 *          STARFOCUS_ERROR_TOO_LARGE */
STARFOCUS_API starfocus_status starfocus_stabiliser_init(const starfocus_config* config,
                                                         void* memory, size_t bytes,
                                                         starfocus_stabiliser** stabiliser,
                                                         starfocus_problem* problem);

/** Measurements of a call of starfocus_stabilise_disparity. */
typedef struct starfocus_stabiliser_report {
  int64_t followed; /**< Pixels that show the same point as a pixel of the frame before. All other
                         pixels, such as those behind a moving object, keep their disparity. */
  int64_t changed;  /**< Followed pixels that got another surface than in the frame before, because
                         the maps before were wrong there, or unknown. */
  int32_t cut;      /**< 1 if less than two fifths of the pixels were followed: the maps start again
                         with this frame, and `followed` is 0. Otherwise 0. */
  double scale;     /**< Change of the whole map: a disparity d of this map is d * scale + offset on
                         the scale of the maps before it. In [0.75, 1.25], 1 without change. */
  double offset;    /**< In pixels of disparity, 0 without change. */
} starfocus_stabiliser_report;

/** Stabilises the map of the next frame of a video. The first frame, and the first frame after a
 *  cut, keep their map.
 *
 *  Each pixel follows the best of the motions around it, which are those of blocks of 8 x 8 pixels.
 *  The scale of the map becomes the mean scale of about 8 maps. The disparity of a pixel becomes
 *  the mean of about 8 disparities that were measured on its surface. Where a map shows another
 *  surface than the maps before it, within 5 pixels of its outlines, the surface with more
 *  measurements wins, and the other surface at the latest in the fifth such map: an outline that is
 *  wrong in a single map does not move. Farther away, the map decides. Unknown disparities become
 *  those of the frame before, or NaN if these are unknown, too.
 *  @param stabiliser stabiliser
 *  @param callbacks runner and progress; null: the calling thread does all work
 *  @param frame frame of width x height pixels, which is read during the call: `views[0]` in any
 *         format of 8 bits, `depth` in any format, as large as the picture or smaller, and
 *         `coverage`, which may be null. Known disparities must be in [disparity_min,
 *         disparity_max]
 *  @param map output planes of width x height pixels. `disparity` may be the plane of
 *         `frame->depth` and `coverage` that of `frame`. `confidence` and `coverage` may be null.
 *         `confidence` receives 255 times the share of the measurements that belong to the surface,
 *         or 0 at pixels with less than two. `coverage` receives the coverage of the frame,
 *         averaged over 3 frames where a surface continues; `has_coverage` is set to 0 if the frame
 *         has no coverage
 *  @param report receives measurements; may be null
 *  @return STARFOCUS_OK, an error of the arguments, STARFOCUS_ERROR_DISPARITY,
 *          STARFOCUS_ERROR_CANCELLED or STARFOCUS_ERROR_RUNNER. After an error, the stabiliser is
 *          in the state before the call, and the output planes are unchanged */
STARFOCUS_API starfocus_status starfocus_stabilise_disparity(starfocus_stabiliser* stabiliser,
                                                             const starfocus_callbacks* callbacks,
                                                             const starfocus_light_field* frame,
                                                             starfocus_disparity_output* map,
                                                             starfocus_stabiliser_report* report);

/** A subject that the focus follows. */
typedef struct starfocus_track {
  int32_t x;    /**< Column of the subject's point in the picture, pixels. */
  int32_t y;    /**< Row of that point. */
  double focus; /**< Disparity of the subject, for starfocus_params.focus. */
  int32_t lost; /**< Number of frames since the subject was last found; 0: it was found in the last
                     frame. While it is lost, the other fields keep their values. */
  uint8_t patch[256]; /**< Picture of the subject, private to the library. */
} starfocus_track;

/** Starts to follow the subject at a point of the last frame, such as a tapped one. The focus is
 *  the median of the stabilised disparities of its surface within 8 pixels. If the disparity of the
 *  point is unknown, it is the median of all known disparities there, or 0 if there are none.
 *  @param stabiliser stabiliser after at least one frame, of at least 16 x 16 pixels
 *  @param x,y point in the picture, pixels
 *  @param track receives the subject
 *  @return STARFOCUS_OK, STARFOCUS_ERROR_STATE before the first frame, or an error of the
 *          arguments */
STARFOCUS_API starfocus_status starfocus_track_begin(starfocus_stabiliser* stabiliser, int32_t x,
                                                     int32_t y, starfocus_track* track);

/** Follows a subject to the last frame. Call this once after each frame. The point moves with the
 *  picture, and then to the place within 3 pixels where the picture looks most like the subject.
 *  The focus is the median of the stabilised disparities of its surface around the point.
 *
 *  The subject is lost if the picture at this place does not look like it or shows another surface,
 *  or if the point leaves the picture. A lost subject is found again within 12 pixels of its last
 *  point.
 *  @param stabiliser stabiliser of starfocus_track_begin
 *  @param track subject, which is updated. Several subjects may be followed
 *  @return STARFOCUS_OK, STARFOCUS_ERROR_STATE before the first frame, or an error of the
 *          arguments */
STARFOCUS_API starfocus_status starfocus_track_focus(starfocus_stabiliser* stabiliser,
                                                     starfocus_track* track);

/** Makes the next frame the first frame of another video, of the same size.
 *  @param stabiliser stabiliser; null: does nothing */
STARFOCUS_API void starfocus_stabiliser_restart(starfocus_stabiliser* stabiliser);

/** Returns the description of the error of the last call with a stabiliser, which is valid until
 *  the next call; null if `stabiliser` is null. */
STARFOCUS_API const starfocus_problem* starfocus_stabiliser_problem(
    const starfocus_stabiliser* stabiliser);

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_VIDEO_H_ */
