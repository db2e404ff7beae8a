"""From a subject and its settings to scenes: cloth recorded, styled, lit and before a camera."""
