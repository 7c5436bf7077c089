#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Makes the figures of docs/method.md in the current folder. The programs starfocus and starfocus-lab must be found by
# PATH, and the plots require gnuplot.
set -eu
starfocus-lab analyze -o figures
starfocus-lab scene portrait --size 640x480 --views 5
starfocus refocus portrait -o blur.png --focus=-5.7 --region 165,40,200,200 --mode blur --views 1
starfocus refocus portrait -o one.png --focus=-5.7 --region 165,40,200,200 --views 1
starfocus refocus portrait -o five.png --focus=-5.7 --region 165,40,200,200
starfocus refocus portrait -o best.png --focus=-5.7 --region 165,40,200,200 --mode benchmark
starfocus-lab sheet blur.png one.png five.png best.png -o occlusion.jpg --width 840 \
  --labels "mode blur,one view,five views,benchmark"
starfocus refocus portrait -o out.png --focus=-8 --map map.png
starfocus refocus portrait -o raw.png --focus=-8 --deblocking 0
starfocus-lab compare out.png raw.png --map deblocked.png
starfocus-lab sheet out.png map.png deblocked.png -o blocks.jpg --width 1000 --labels "picture,blocks,deblocked"
starfocus-lab scene hair --name hair --size 640x480 --views 5
starfocus refocus hair -o sharp.png --focus=-7 --region 180,60,200,200 --aperture 0.01
starfocus refocus hair -o blur.png --focus=-7 --region 180,60,200,200 --mode blur --views 1
starfocus refocus hair -o scan.png --focus=-7 --region 180,60,200,200 --renderer line-scan
starfocus refocus hair -o slices.png --focus=-7 --region 180,60,200,200
starfocus-lab sheet sharp.png blur.png scan.png slices.png -o hair.jpg --width 840 \
  --labels "centre view,mode blur,line-scan,slices"
starfocus-lab steps portrait -o steps --focus=-5.7
starfocus refocus portrait -o wall.png --focus=-5.7
starfocus-lab sheet portrait/view_-1.0_+0.0.png portrait/view_+0.0_+0.0.png portrait/view_+1.0_+0.0.png \
  steps/disparity.png -o views.jpg --crop 200,40,150,150 --labels "view (-1 0),centre view,view (1 0),disparity"
starfocus-lab sheet steps/mean.png wall.png -o mean.jpg --crop 200,165,130,100 --zoom 2 \
  --labels "mean of views,refocused"
starfocus-lab sheet portrait/view_+0.0_+0.0.png steps/holes.png steps/view.png -o holes.jpg --crop 200,40,165,150 \
  --labels "centre view,holes,rendered view"
starfocus-lab sheet portrait/view_+0.0_+0.0.png steps/hidden.png -o hidden.png --crop 165,60,100,80 --zoom 4 \
  --labels "centre view,first hidden surface"
starfocus-lab sheet portrait/view_+0.0_+0.0.png steps/matte.png -o matte.png --crop 165,70,65,50 --zoom 6 \
  --labels "centre view,share of the nearer surface"
starfocus-lab sheet steps/disparity.png steps/slices.png -o slices.jpg --crop 340,120,300,280 \
  --labels "disparity,slices"
starfocus-lab sheet steps/gathered.png -o gathered.jpg --width 400
mv hair/coverage.png truth.png
starfocus-lab steps hair -o strands --focus=-7
starfocus-lab sheet hair/view_+0.0_+0.0.png strands/disparity.png strands/coverage.png truth.png -o coverage.png \
  --crop 190,80,100,100 --zoom 2 --labels "centre view,disparity,coverage,truth"
