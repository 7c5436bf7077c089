// SPDX-License-Identifier: Apache-2.0
import dev.starfocus.*
import java.io.FileOutputStream
import java.io.RandomAccessFile
import java.nio.ByteBuffer
import java.nio.channels.FileChannel.MapMode.READ_ONLY

/**
 * Tap to focus: refocuses a frame at the pixel (x, y) that a user tapped. `frame` and `out` are NV12
 * in limited range; `depth` contains distances at 1/4 of the width and height. Throws
 * StarfocusException with the cause of an error.
 */
fun tapToFocus(frame: Image, depth: DepthMap, width: Int, height: Int, x: Int, y: Int, out: Image) {
  val range = Refocuser.measureDisparity(depth)
  val configuration = Configuration().also {
    it.width = width
    it.height = height
    it.views = 1
    it.fillUnknown = 1
    it.disparityMin = range[0]
    it.disparityMax = range[1]
  }
  Refocuser(configuration).use { refocuser ->
    refocuser.prepare(LightField(arrayOf(frame), depth))
    val lens = Parameters()
    lens.focus = Refocuser.focusAt(depth, width, height, x, y)
    lens.aperture = refocuser.largestAperture(lens)
    refocuser.refocusPrepared(lens, out)
  }
}

/** Maps a file into memory, like the buffers of a camera. */
fun read(path: String): ByteBuffer =
  RandomAccessFile(path, "r").use { it.channel.map(READ_ONLY, 0, it.length()) }

fun nv12(planes: ByteBuffer, width: Int, height: Int): Image {
  val chroma = planes.duplicate()
  chroma.position(width * height)
  return Image(Image.NV12, arrayOf(planes, chroma), intArrayOf(width, width))
}

/** Usage: FRAME DEPTH WIDTH HEIGHT X Y OUT, as for phone.c. */
fun main(arguments: Array<String>) {
  val (width, height, x, y) = arguments.slice(2..5).map { it.toInt() }
  val depth = DepthMap(DepthMap.U16, read(arguments[1]), width / 2, width / 4, height / 4)
  depth.meaning = DepthMap.RECIPROCAL // disparity = 8000 / distance; 0: unknown
  depth.scale = 8000.0
  depth.hasInvalid = 1
  val picture = ByteBuffer.allocateDirect(width * height * 3 / 2)
  tapToFocus(nv12(read(arguments[0]), width, height), depth, width, height, x, y,
    nv12(picture, width, height))
  FileOutputStream(arguments[6]).use { it.channel.write(picture) }
}
