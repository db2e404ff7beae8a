"""The methods that step a cloth, one file each."""
