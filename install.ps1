# Downloads a prebuilt wasmouse for Windows, checks its SHA-256, and puts it into a folder of yours.
#
#     powershell -ExecutionPolicy Bypass -File install.ps1 [-Version VERSION] [-To FOLDER]
#
# WASMOUSE_REPOSITORY and WASMOUSE_DOWNLOAD mean what they mean for install.sh.
param(
    [string]$Version = '',
    [string]$To = (Join-Path $env:LOCALAPPDATA 'Programs\wasmouse')
)
$ErrorActionPreference = 'Stop'
$ProgressPreference = 'SilentlyContinue'

# The release workflow puts the address of the repository here.
$PublishedAt = ''

$Version = $Version -replace '^v', ''
$From = $env:WASMOUSE_DOWNLOAD
if (-not $From) {
    $Repository = if ($env:WASMOUSE_REPOSITORY) { $env:WASMOUSE_REPOSITORY } else { $PublishedAt }
    if (-not $Repository) {
        throw 'no repository to download from: set WASMOUSE_REPOSITORY to its address'
    }
    $From = if ($Version) { "$Repository/releases/download/v$Version" }
    else { "$Repository/releases/latest/download" }
}
$Name = 'wasmouse-x86_64-pc-windows-msvc'
$Temporary = Join-Path ([IO.Path]::GetTempPath()) ([IO.Path]::GetRandomFileName())
New-Item -ItemType Directory -Path $Temporary | Out-Null
try {
    $Archive = Join-Path $Temporary "$Name.tar.gz"
    Invoke-WebRequest -UseBasicParsing -Uri "$From/$Name.tar.gz" -OutFile $Archive
    Invoke-WebRequest -UseBasicParsing -Uri "$From/$Name.tar.gz.sha256" -OutFile "$Archive.sha256"
    $Expected = ((Get-Content -Raw "$Archive.sha256") -split ' ')[0]
    $Actual = (Get-FileHash -Algorithm SHA256 $Archive).Hash.ToLowerInvariant()
    if ($Actual -ne $Expected) {
        throw "$Name.tar.gz has the SHA-256 $Actual and should have $Expected; nothing was installed"
    }
    # A part of Windows since 10.
    tar -xzf $Archive -C $Temporary
    if ($LASTEXITCODE -ne 0) { throw "failed to unpack $Name.tar.gz" }
    $Program = Join-Path $Temporary "$Name\wasmouse.exe"
    $Installed = & $Program --version
    if ($Version -and $Installed -ne "wasmouse $Version") {
        throw "the archive has $Installed instead of wasmouse $Version; nothing was installed"
    }
    New-Item -ItemType Directory -Force -Path $To | Out-Null
    Move-Item -Force -Path $Program -Destination (Join-Path $To 'wasmouse.exe')
    Write-Output "installed $(Join-Path $To 'wasmouse.exe')"
}
finally {
    Remove-Item -Recurse -Force $Temporary
}
