/* SPDX-License-Identifier: Apache-2.0 */
/** @file
 * Video: disparity maps that do not flicker. Programs that refocus single pictures do not need this
 * header. The conventions of starfocus.h apply.
 *
 * The maps of networks and sensors change from frame to frame where the scene does not, and the
 * blur changes with them. A stabiliser follows the motion of the picture and fuses the map of each
 * frame with those before it. It adds no delay: the map of a frame depends on this frame and the
 * frames before.
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
 */
#ifndef STARFOCUS_VIDEO_H_
#define STARFOCUS_VIDEO_H_

#include "starfocus/depth.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A stabiliser, which lives in memory of the caller and needs no destructor. */
typedef struct starfocus_stabiliser starfocus_stabiliser;

/** Computes the size of the memory of a stabiliser: 27 bytes per pixel of the picture.
 *
 *  The functions of this header read these fields of starfocus_config: size, width, height,
 *  disparity_min, disparity_max and max_workers.
 *  @param config configuration
 *  @param bytes receives the size
 *  @param problem receives the cause of an error; may be null
 *  @return STARFOCUS_OK, an error of the configuration or STARFOCUS_ERROR_TOO_LARGE */
STARFOCUS_API starfocus_status starfocus_stabiliser_size(const starfocus_config* config,
                                                         size_t* bytes, starfocus_problem* problem);

/** Creates a stabiliser.
 *  @param config configuration
 *  @param memory memory aligned to STARFOCUS_ALIGNMENT, which the stabiliser uses until its end
 *  @param bytes size of the memory, at least starfocus_stabiliser_size
 *  @param stabiliser receives the stabiliser, at the beginning of the memory
 *  @param problem receives the cause of an error; may be null
 *  @return STARFOCUS_OK, or an error of the arguments */
STARFOCUS_API starfocus_status starfocus_stabiliser_init(const starfocus_config* config,
                                                         void* memory, size_t bytes,
                                                         starfocus_stabiliser** stabiliser,
                                                         starfocus_problem* problem);

/** What a stabiliser found in a frame. */
typedef struct starfocus_stabiliser_report {
  int64_t followed; /**< Pixels that show the same point as a pixel of the frame before. All other
                         pixels, such as those behind a moving object, keep their measurement. */
  int64_t changed;  /**< Followed pixels whose surface changed: an outline of the maps before was
                         wrong. */
  int32_t cut;      /**< 1 if less than two fifths of the pixels were followed, so that the maps
                         start anew with this frame; else 0. */
  double scale;     /**< The map was multiplied by this, */
  double offset;    /**< and this was added, because maps of networks change as a whole. */
} starfocus_stabiliser_report;

/** Stabilises the map of the next frame of a video. The first frame, and the first frame after a
 *  cut, keep their map.
 *
 *  Pixels follow the best of the motions around them, which are those of blocks of 8 x 8 pixels.
 *  The map is first multiplied by a scale and shifted to the mean scale of the last 8 maps. The
 *  disparity of a pixel becomes the mean of the disparities that were measured on its surface, of
 *  up to 8 frames. Where a map shows another surface than the maps before, the surface with more
 *  measurements wins: an outline that is wrong in a single map does not move. Unknown disparities
 *  are those of the frame before, or remain NaN.
 *  @param stabiliser stabiliser
 *  @param callbacks runner and progress; null: the calling thread does all work
 *  @param frame frame: `views[0]` of any format, `depth` of any format, and `coverage`, which may
 *         be null. The known disparities must lie in the configured range
 *  @param map output planes. `disparity` may be the plane of `frame->depth`. `confidence` receives
 *         255 times the share of the measurements that belong to the surface, and 0 at new pixels.
 *         `coverage` receives the coverage of the frame, averaged over 3 frames where a surface
 *         continues
 *  @param report receives what was found; may be null
 *  @return STARFOCUS_OK, an error of the arguments, STARFOCUS_ERROR_DISPARITY,
 *          STARFOCUS_ERROR_CANCELLED or STARFOCUS_ERROR_RUNNER. After an error, the stabiliser is
 *          in the state before the call */
STARFOCUS_API starfocus_status starfocus_stabilise_disparity(starfocus_stabiliser* stabiliser,
                                                             const starfocus_callbacks* callbacks,
                                                             const starfocus_light_field* frame,
                                                             starfocus_disparity_output* map,
                                                             starfocus_stabiliser_report* report);

/** A subject that the focus follows. */
typedef struct starfocus_track {
  int32_t x, y; /**< Place of the point in the picture, pixels. */
  double focus; /**< Disparity of the subject, for starfocus_params.focus. */
  int32_t lost; /**< Number of frames since the subject was seen last; 0: it is seen. While it is
                     lost, the other fields keep their values. */
  uint8_t patch[256]; /**< What the subject looks like; of the library. */
} starfocus_track;

/** Starts to follow the subject at a point of the last frame, such as a tapped one.
 *  @param stabiliser stabiliser of at least one frame, of at least 16 x 16 pixels
 *  @param x,y point in the picture
 *  @param track receives the subject
 *  @return STARFOCUS_OK, STARFOCUS_ERROR_STATE before the first frame, or an error of the
 *          arguments */
STARFOCUS_API starfocus_status starfocus_track_begin(starfocus_stabiliser* stabiliser, int32_t x,
                                                     int32_t y, starfocus_track* track);

/** Follows a subject to the last frame. Call this once after each frame. The point moves with the
 *  picture, and then to the place within 3 pixels where the picture looks most like the subject.
 *  The focus is the median of the stabilised disparities of its surface around the point.
 *
 *  The subject is lost if the picture does not look like it, or shows another surface, or if the
 *  point leaves the picture. It is found again within 12 pixels of its last place.
 *  @param stabiliser stabiliser
 *  @param track subject, which is updated
 *  @return STARFOCUS_OK, STARFOCUS_ERROR_STATE before the first frame, or an error of the
 *          arguments */
STARFOCUS_API starfocus_status starfocus_track_focus(starfocus_stabiliser* stabiliser,
                                                     starfocus_track* track);

/** Makes the next frame the first frame of another video. */
STARFOCUS_API void starfocus_stabiliser_restart(starfocus_stabiliser* stabiliser);

/** Returns the description of the error of the last call with a stabiliser. */
STARFOCUS_API const starfocus_problem* starfocus_stabiliser_problem(
    const starfocus_stabiliser* stabiliser);

#ifdef __cplusplus
}
#endif

#endif /* STARFOCUS_VIDEO_H_ */
