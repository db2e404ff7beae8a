"""A banner waves in a seamless loop, and the frames of another loop are drawn one by one."""

from drapery import Banner, Settings, animate, iter_frames

banner = Banner.parse("red cross:white border:yellow")
settings = Settings(view="hero", wind=6, size=(128, 160), background="#b9cfe4")
animate(banner, settings, seconds=2, fps=15).save("waving.webp")
for number, frame in enumerate(iter_frames(banner, settings, seconds=0.5, fps=8)):
    frame.save(f"frame-{number}.png")
