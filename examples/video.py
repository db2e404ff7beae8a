"""Frames as numpy arrays, and a video that is written while they are drawn."""

import av

from drapery import Banner, iter_frames

banner = Banner.parse("white gradient_up:light_blue triangle_top:orange")
with av.open("banner.mp4", "w") as video:
    stream = video.add_stream("libx264", rate=20, width=256, height=320, pix_fmt="yuv420p")
    for frame in iter_frames(banner, size=(256, 320), view="hero", background="#b9cfe4"):
        video.mux(stream.encode(av.VideoFrame.from_ndarray(frame.pixels, format="rgba")))
    video.mux(stream.encode())
