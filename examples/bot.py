"""A Discord bot of one command: it answers a design with its banner, drawn by `drapery serve`."""

import asyncio
import io
import json
import os
from urllib.error import HTTPError
from urllib.parse import urlencode
from urllib.request import urlopen


def answer(design: str, service: str = "http://127.0.0.1:8000") -> bytes | str:
    """The moving picture of a design, or a line that says why there is none."""
    words = {"design": design, "size": "192x240", "view": "hero", "seconds": 2, "fps": 10}
    try:
        with urlopen(f"{service}/banner.gif?{urlencode(words)}", timeout=60) as response:
            return bytes(response.read())
    except HTTPError as error:
        return "; ".join(json.load(error)["detail"])[:2000]
    except OSError:
        return "No picture now; try again later."


if __name__ == "__main__":
    import discord

    bot = discord.Client(intents=discord.Intents.default())
    commands = discord.app_commands.CommandTree(bot)
    bot.setup_hook = commands.sync

    @commands.command(description="Show a banner as cloth")
    async def banner(interaction: discord.Interaction, design: str) -> None:
        await interaction.response.defer()
        found = await asyncio.to_thread(answer, design)
        files = [] if isinstance(found, str) else [discord.File(io.BytesIO(found), "banner.gif")]
        await interaction.followup.send("" if files else found, files=files)

    bot.run(os.environ["DISCORD_TOKEN"])
